#version 450 core
// 5.4 The furthest node of 4 x 4 texels, or of 4 x 4 of the level below: so that triangles which no receiver lies behind end
// in the geometry shader, as hardware's hierarchical z-cull would end them before the fragments.
#include "shared/bindings.h"
#include "shared/light.h"
#include "shared/pyramid.h"

layout(local_size_x = 16, local_size_y = 16) in;

layout(std140, binding = BIND_LIGHT) uniform LightBlock { LightFrame light; };
layout(binding = IMAGE_FURTHEST, r32ui) readonly uniform uimage2DArray furthest;
layout(binding = IMAGE_PYRAMID, r32ui) uniform uimage2DArray pyramid;
layout(location = 0) uniform int level;

void main() {
  int side = int(light.grid.x);
  int layer = int(gl_WorkGroupID.z);
  ivec2 at = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(at, ivec2(pyramid_side(side, level))))) return;
  ivec2 last = ivec2(level == 0 ? side : pyramid_side(side, level - 1)) - 1;
  uint deepest = 0u;
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 4; ++x) {
      ivec2 below = min(at * 4 + ivec2(x, y), last);
#ifdef FIRST_LEVEL
      deepest = max(deepest, imageLoad(furthest, ivec3(below, layer)).x);
#else
      deepest = max(deepest, imageLoad(pyramid, ivec3(pyramid_origin(side, level - 1) + below, layer)).x);
#endif
    }
  imageStore(pyramid, ivec3(pyramid_origin(side, level) + at, layer), uvec4(deepest));
}
