#version 450 core
// The depth map: casters as the light sees them, in one layer of the map. MASKED: with what their alpha mask takes.
#include "shared/bindings.h"
#include "shared/depth_map.h"

layout(std140, binding = BIND_LIGHT) uniform LightBlock { LightFrame light; };
layout(std140, binding = BIND_WINDOWS) uniform WindowBlock { LightWindow windows[max_layers]; };
layout(std430, binding = BIND_INSTANCES) readonly buffer InstanceBlock { InstanceFrame instances[]; };
layout(location = 0) uniform int layer;
layout(location = 1) uniform float margin;  // texels

layout(location = ATTRIBUTE_POSITION) in vec3 position;
layout(location = ATTRIBUTE_INSTANCE) in uint instance_index;
#ifdef MASKED
layout(location = 0) flat out uint v_instance;
#endif

void main() {
  LightFrame face = light_face(light, layer / int(light.grid.y));
  LightWindow window = with_margin(windows[layer], margin);
  vec3 p = view_from_object(instances[instance_index], position);
  gl_Position = map_clip(face, window, float(light.grid.x), p);
  // No receiver is seen through this layer: nothing is drawn.
  if (window.guard.y == 0.0) gl_Position = vec4(2.0, 2.0, 0.0, 1.0);
#ifdef MASKED
  v_instance = instance_index;
#endif
}
