// 5.4 by triangles, for those who have a footprint: the pyramid of furthest depths (shared/pyramid.h) ends those that no receiver
// lies behind.
#include "shared/pyramid.h"

layout(binding = UNIT_PYRAMID) uniform usampler2DArray pyramid;

// Of texels from `low` to `high`, by level k, of which they meet two squares along each axis at most.
uint furthest_within(ivec2 low, ivec2 high, int k, int layer) {
  int log_texels = 2 * (k + 1);
  ivec2 last = ivec2(int(light.grid.x) - 1) >> log_texels;
  ivec2 origin = pyramid_origin(int(light.grid.x), k);
  low = origin + clamp(low >> log_texels, ivec2(0), last);
  high = origin + clamp(high >> log_texels, ivec2(0), last);
  return max(max(texelFetch(pyramid, ivec3(low, layer), 0).x, texelFetch(pyramid, ivec3(high, layer), 0).x),
             max(texelFetch(pyramid, ivec3(low.x, high.y, layer), 0).x,
                 texelFetch(pyramid, ivec3(high.x, low.y, layer), 0).x));
}

// Is no receiver of the texels that the footprint can touch behind it?
bool behind_all(Footprint f, int layer) {
  vec2 size = f.box.zw - f.box.xy;
  float largest = max(size.x, size.y);
  int k = 0;
  for (float texels = 4.0; texels < largest && k < pyramid_levels - 1; texels *= 4.0) ++k;
  uint furthest = furthest_within(ivec2(floor(f.box.xy)), ivec2(floor(f.box.zw)), k, layer);
  float nearest = min(min(f.p0.z, f.p1.z), f.count == 4 ? min(f.p2.z, f.p3.z) : f.p2.z);
  return max(nearest, 0.0) >= uintBitsToFloat(furthest);
}
