#version 450 core
// 5.2 The light's windows fit the receivers of their cascades each frame, without a read-back.
#include "shared/bindings.h"
#include "shared/bounds.h"

layout(local_size_x = max_cascades) in;

layout(std140, binding = BIND_LIGHT) uniform LightBlock { LightFrame light; };
layout(std430, binding = BIND_BOUNDS) readonly buffer BoundsBlock { ReceiverBounds all_bounds[max_cascades]; };
layout(std430, binding = BIND_WINDOW) writeonly buffer WindowBlock { LightWindow windows[max_cascades]; };

void main() {
  uint cascade = gl_LocalInvocationID.x;
  windows[cascade] = make_window(light, all_bounds[cascade]);
}
