#version 450 core
#extension GL_NV_geometry_shader_passthrough : require
// 5.5 Hardware conservative rasterisation (7): positions pass through, the vertices for the test go along once a triangle.
// CASCADES: into the first layer of `cascades`, since such a shader makes one triangle of one.
#include "shared/bindings.h"
#include "shared/light.h"
#include "shared/pairs.h"
#include "shadow/izb/vertices.glsl"

layout(triangles) in;
layout(passthrough) in gl_PerVertex { vec4 gl_Position; } gl_in[];
#ifdef CASCADES
layout(location = 2) uniform ivec2 cascades;
#endif

layout(std140, binding = BIND_LIGHT) uniform LightBlock { LightFrame light; };

layout(location = 0) in vec3 v_position_vs[];
layout(location = 1) flat in uint v_instance[];

layout(location = 0) flat out vec3 g_a;
layout(location = 1) flat out vec3 g_b;
layout(location = 2) flat out vec3 g_c;
layout(location = 4) flat out uvec2 g_id;

#ifdef COUNT
layout(std430, binding = BIND_COUNTERS) buffer CounterBlock { Counters counters; };
#endif

void main() {
  vec3 a = v_position_vs[0], b = v_position_vs[1], c = v_position_vs[2];
  // What casts nothing, and what has a vertex at a place that is not its own: no id, and the fragments end.
  bool left_out = a == b || b == c || c == a;
  if (is_positional(light))
    left_out = left_out || min(light_position(light, a).z, min(light_position(light, b).z, light_position(light, c).z)) <= 0.0;
#if defined(SPP32) && !defined(IN_DOUBLE)
  order_vertices(a, b, c);
#endif
  g_a = a;
  g_b = b;
  g_c = c;
  g_id = left_out ? uvec2(0u) : uvec2(v_instance[0] + 1u, uint(gl_PrimitiveIDIn));
#ifdef CASCADES
  gl_Layer = cascades.x;
#endif
#ifdef COUNT
  if (!left_out) atomicAdd(counters.triangles, 1u);
#endif
}
