#version 450 core
// 5.5 Spawning triangle visibility tests: vertices to view space, where the test takes place.
// HW: to the light-space grid, too, where hardware rasterises them conservatively. MASKED: with what their alpha mask takes.
// PULL: without attributes, of the triangles that are listed to be drawn; IN_DOUBLE: of all.
#include "shared/bindings.h"
#include "shared/camera.h"

#ifdef PULL
#include "shared/geometry.glsl"
#include "shared/sweep.h"
#ifdef MASKED
#include "shared/uvs.glsl"
#endif

#ifdef IN_DOUBLE
layout(location = 4) uniform int instance_count;
layout(location = 5) uniform uint first_triangle;
#else
layout(std430, binding = BIND_LISTED) readonly buffer ListedBlock { ListedTriangle listed[]; };
#endif
#else
layout(std430, binding = BIND_INSTANCES) readonly buffer InstanceBlock { InstanceFrame instances[]; };
#endif

#ifdef HW
#include "shared/footprint.h"

layout(std140, binding = BIND_LIGHT) uniform LightBlock { LightFrame light; };
layout(std140, binding = BIND_WINDOWS) uniform WindowBlock { LightWindow windows[max_layers]; };
#ifdef LAYERS
layout(location = 2) uniform ivec2 layers;
#else
const ivec2 layers = ivec2(0, 1);
#endif
layout(location = 4) uniform vec2 shift;  // texels

out gl_PerVertex { vec4 gl_Position; };  // what 5_visibility_hw.geom.glsl passes through
#endif

layout(location = 0) out vec3 v_position_vs;
layout(location = 1) flat out uint v_instance;
#ifdef MASKED
layout(location = 5) out vec2 v_uv;
#endif

#ifdef PULL
layout(location = 2) flat out uint v_triangle;
layout(location = 3) flat out uint v_layer;

void main() {
#ifdef IN_DOUBLE
  uint n = first_triangle + uint(gl_VertexID) / 3u;
  v_instance = instance_of(n, instance_count);
  v_triangle = n - instances[v_instance].info.x;
  v_layer = uint(gl_InstanceID);
#else
  ListedTriangle t = listed[drawn_entry(uint(gl_VertexID) / 3u)];
  v_instance = t.instance;
  v_triangle = triangle_of(t);
  v_layer = layer_of(t);
#endif
  InstanceFrame instance = instances[v_instance];
  uint corner = instance.info.z + v_triangle * 3u + uint(gl_VertexID) % 3u;
  v_position_vs = vertex_vs(instance, corner);
#ifdef MASKED
  v_uv = uv_at(instance, corner);
#endif
}
#else
layout(location = ATTRIBUTE_POSITION) in vec3 position;
layout(location = ATTRIBUTE_INSTANCE) in uint instance_index;
#ifdef MASKED
layout(location = ATTRIBUTE_UV) in vec2 uv;
#endif

void main() {
  v_position_vs = view_from_object(instances[instance_index], position);
  v_instance = instance_index;
#ifdef MASKED
  v_uv = uv;
#endif
#ifdef HW
  vec3 corner = hardware_vertex(light_face(light, layers.x / int(light.grid.y)), windows[layers.x], v_position_vs);
  gl_Position = vec4((corner.xy + shift) * (2.0 / float(light.grid.x)) - 1.0, corner.z, 1.0);
#endif
}
#endif
