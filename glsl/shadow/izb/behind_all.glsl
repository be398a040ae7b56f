// 5.4 by triangles, for those who have a footprint: the pyramid of furthest depths (shared/pyramid.h) ends those that no receiver
// lies behind.
#include "shared/pyramid.h"

layout(binding = UNIT_PYRAMID) uniform usampler2DArray pyramid;

// Is no receiver of the texels that the footprint can touch behind it?
bool behind_all(Footprint f, int layer) {
  vec2 size = f.box.zw - f.box.xy;
  float largest = max(size.x, size.y);
  int k = 0;
  for (float texels = 4.0; texels < largest && k < pyramid_levels - 1; texels *= 4.0) ++k;
  int log_texels = 2 * (k + 1);
  ivec2 last = ivec2(int(light.grid.x) - 1) >> log_texels;
  ivec2 origin = pyramid_origin(int(light.grid.x), k);
  ivec2 low = origin + clamp(ivec2(floor(f.box.xy)) >> log_texels, ivec2(0), last);
  ivec2 high = origin + clamp(ivec2(floor(f.box.zw)) >> log_texels, ivec2(0), last);
  uint furthest = max(max(texelFetch(pyramid, ivec3(low, layer), 0).x, texelFetch(pyramid, ivec3(high, layer), 0).x),
                      max(texelFetch(pyramid, ivec3(low.x, high.y, layer), 0).x,
                          texelFetch(pyramid, ivec3(high.x, low.y, layer), 0).x));
  float nearest = min(min(f.p0.z, f.p1.z), f.count == 4 ? min(f.p2.z, f.p3.z) : f.p2.z);
  return max(nearest, 0.0) >= uintBitsToFloat(furthest);
}
