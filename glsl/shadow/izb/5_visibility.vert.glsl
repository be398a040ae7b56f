#version 450 core
// 5.5 Spawning triangle visibility tests: vertices to view space, where the test takes place.
// HW: to the light-space grid, too, where hardware rasterises them conservatively. MASKED: with what their alpha mask takes.
#include "shared/bindings.h"
#include "shared/camera.h"

layout(std430, binding = BIND_INSTANCES) readonly buffer InstanceBlock { InstanceFrame instances[]; };

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

layout(location = ATTRIBUTE_POSITION) in vec3 position;
layout(location = ATTRIBUTE_INSTANCE) in uint instance_index;

layout(location = 0) out vec3 v_position_vs;
layout(location = 1) flat out uint v_instance;
#ifdef MASKED
layout(location = ATTRIBUTE_UV) in vec2 uv;
layout(location = 5) out vec2 v_uv;
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
