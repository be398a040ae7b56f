#version 450 core
// 5.2 The light's window fits the receivers each frame, without a read-back.
#include "shared/bindings.h"
#include "shared/bounds.h"

layout(local_size_x = 1) in;

layout(std140, binding = BIND_LIGHT) uniform LightBlock { LightFrame light; };
layout(std430, binding = BIND_BOUNDS) readonly buffer BoundsBlock { ReceiverBounds bounds; };
layout(std430, binding = BIND_WINDOW) writeonly buffer WindowBlock { LightWindow window; };

void main() { window = make_window(light, bounds); }
