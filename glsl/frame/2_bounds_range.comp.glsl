#version 450 core
// 5.2, 6.4 The visible depth range, which the cascades share.
#include "frame/for_each_receiver.glsl"

layout(std430, binding = BIND_CASCADES) buffer CascadeBlock { CascadeRange range; };

float nearest = 3.0e38, furthest = 0.0;

void visit(CameraFrame eye, LightFrame lamp, ivec2 px, float t, vec3 p) {
  nearest = min(nearest, t);
  furthest = max(furthest, t);
}

void main() {
  for_each_receiver();
  if (furthest == 0.0) return;
  atomicMin(range.reached.x, floatBitsToUint(nearest));
  atomicMax(range.reached.y, floatBitsToUint(furthest));
}
