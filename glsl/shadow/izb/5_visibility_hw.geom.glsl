#version 450 core
#extension GL_NV_geometry_shader_passthrough : require
// Without this NVIDIA's linker (580.159) asks a core profile's passthrough shader for max_vertices, and refuses it with them.
#extension GL_EXT_geometry_shader4 : enable
// 5.5 Hardware conservative rasterisation (7): positions pass through, the vertices for the test go along once a triangle.
// LAYERS: into the first of `layers`, since such a shader makes one triangle of one.
layout(triangles) in;
layout(passthrough) in gl_PerVertex { vec4 gl_Position; } gl_in[];
#include "shadow/izb/vertices.glsl"
#ifdef LAYERS
layout(location = 2) uniform ivec2 layers;
#endif

layout(std140, binding = BIND_LIGHT) uniform LightBlock { LightFrame light; };

void main() {
  vec3 a = v_position_vs[0], b = v_position_vs[1], c = v_position_vs[2];
  // What casts nothing, and what has a vertex at a place that is not its own: no id, and the fragments end.
  bool left_out = a == b || b == c || c == a || holds_light(light, a, b, c);
  if (is_positional(light)) {
    LightFrame face = light;
#ifdef CUBE
    face = light_face(light, layers.x / int(light.grid.y));
#endif
    left_out = left_out || min(light_position(face, a).z, min(light_position(face, b).z, light_position(face, c).z)) <= 0.0;
  }
  hand_over(make_vertices());
  g_id = left_out ? uvec2(0u) : uvec2(v_instance[0] + 1u, uint(gl_PrimitiveIDIn));
#ifdef LAYERS
  gl_Layer = layers.x;
#endif
#ifdef COUNT
  if (!left_out) atomicAdd(counters.triangles, 1u);
#endif
}
