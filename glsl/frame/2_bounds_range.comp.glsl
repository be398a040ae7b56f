#version 450 core
// 5.2, 6.4 The visible depth range, which the cascades share.
struct Gathered {
  float nearest, furthest;
};
#include "frame/for_each_receiver.glsl"

layout(std430, binding = BIND_CASCADES) buffer CascadeBlock { CascadeRange range; };

void visit(CameraFrame eye, LightFrame lamp, ivec2 px, float t, vec3 p, inout Gathered gathered) {
  gathered.nearest = min(gathered.nearest, t);
  gathered.furthest = max(gathered.furthest, t);
}

void main() {
  Gathered gathered = Gathered(3.0e38, 0.0);
  for_each_receiver(gathered);
  if (gathered.furthest == 0.0) return;
  atomicMin(range.reached.x, floatBitsToUint(gathered.nearest));
  atomicMax(range.reached.y, floatBitsToUint(gathered.furthest));
}
