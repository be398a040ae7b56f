#version 450 core
// 5.2 The light's windows fit the receivers of their layers each frame, without a read-back.
// Defines: MICRO_QUAD.
#include "shared/bindings.h"
#include "shared/bounds.h"

layout(local_size_x = max_layers) in;

layout(std140, binding = BIND_LIGHT) uniform LightBlock { LightFrame light; };
layout(std430, binding = BIND_BOUNDS) readonly buffer BoundsBlock { ReceiverBounds all_bounds[max_layers]; };
layout(std430, binding = BIND_WINDOW) writeonly buffer WindowBlock { LightWindow windows[max_layers]; };

void main() {
  uint layer = gl_LocalInvocationID.x;
#ifdef MICRO_QUAD
  windows[layer] = make_quad_window(light, all_bounds[layer]);
#else
  windows[layer] = make_window(light, all_bounds[layer]);
#endif
}
