// SPDX-License-Identifier: MIT
// Alpha masks (glTF: a point is there if its alpha is at least the cut-off): the alpha channel of a base-colour texture at a
// point of it, level 0, filtered by this text alone, since hardware filters with weights of its own. Where the point lies is
// hits.h's concern.
#ifndef IZB_SHARED_ALPHA_H
#define IZB_SHARED_ALPHA_H
#include "shared/gbuffer.h"
SHARED_BEGIN

const uint wrap_repeat = 0u;
const uint wrap_mirrored = 1u;
const uint wrap_clamp = 2u;

// MaterialFrame::alpha.z.
const uint alpha_nearest_bit = 16u;  // below it: wrap of u, and from bit 2 on of v
const uint alpha_masked_bit = 32u;

struct AlphaMap {
  ivec2 size;  // texels
  uvec2 wrap;
  int first;   // its first texel among those of all maps, row by row, the top one first
  bool nearest;
  float factor;  // what a texel's alpha is multiplied by
  float cutoff;  // in 255ths
};

SHARED bool is_masked(IN(MaterialFrame) m) { return (m.alpha.z & alpha_masked_bit) != 0u; }

SHARED AlphaMap alpha_map(IN(MaterialFrame) m) {
  AlphaMap map;
  map.size = ivec2(int(m.alpha.y & 0xffffu), int(m.alpha.y >> 16));
  map.wrap = uvec2(m.alpha.z & 3u, (m.alpha.z >> 2) & 3u);
  map.first = int(m.alpha.x);
  map.nearest = (m.alpha.z & alpha_nearest_bit) != 0u;
  map.factor = m.base_color.w;
  map.cutoff = m.uv_u.w;
  return map;
}

// In texels of the map, not wrapped: (0, 0) is the outer corner of the first.
SHARED dvec2 texel_position(IN(MaterialFrame) m, IN(vec2) uv) {
  dvec2 size = dvec2(double(m.alpha.y & 0xffffu), double(m.alpha.y >> 16));
  PRECISE double u = (double(m.uv_u.x) * double(uv.x) + double(m.uv_u.y) * double(uv.y)) + double(m.uv_u.z);
  PRECISE double v = (double(m.uv_v.x) * double(uv.x) + double(m.uv_v.y) * double(uv.y)) + double(m.uv_v.z);
  PRECISE double x = u * size.x;
  PRECISE double y = v * size.y;
  return dvec2(x, y);
}

SHARED int wrap_period(int size, uint wrap) { return wrap == wrap_mirrored ? 2 * size : size; }

// The coordinate within one period of the texture, ends included; where the border texel goes on, cut beyond it. A coordinate that is
// no number becomes the lower end.
SHARED double within_period(double x, int size, uint wrap) {
  double period = double(wrap_period(size, wrap));
  PRECISE double turns = floor(x / period);
  PRECISE double rest = x - turns * period;
  bool clamped = wrap == wrap_clamp;
  double low = clamped ? -1.0 : 0.0;
  double y = clamped ? x : rest;
  if (!(y >= low)) y = low;
  return y > period ? period : y;
}

// i from -1 (only where it is clamped) to period + 1.
SHARED int wrapped_texel(int i, int size, uint wrap) {
  int period = wrap_period(size, wrap);
  int j = i >= period ? i - period : i;
  if (j >= period) j -= period;
  if (wrap == wrap_clamp) j = i;
  else if (j >= size) j = period - 1 - j;
  return clamp(j, 0, size - 1);
}

// The four texels around a point, and where between them it lies; one of them where no filter is asked for.
struct AlphaTexels {
  ivec4 index;  // among the texels of all maps: (0, 0), (1, 0), (0, 1), (1, 1)
  vec2 between;
};

SHARED AlphaTexels alpha_texels(IN(AlphaMap) map, IN(dvec2) texel) {
  double shift = map.nearest ? 0.0 : 0.5;
  PRECISE double x_shifted = texel.x - shift;
  PRECISE double y_shifted = texel.y - shift;
  double x = within_period(x_shifted, map.size.x, map.wrap.x);
  double y = within_period(y_shifted, map.size.y, map.wrap.y);
  double x_floor = floor(x);
  double y_floor = floor(y);
  int i = int(x_floor);
  int j = int(y_floor);
  int left = wrapped_texel(i, map.size.x, map.wrap.x);
  int right = wrapped_texel(i + 1, map.size.x, map.wrap.x);
  int top = map.first + wrapped_texel(j, map.size.y, map.wrap.y) * map.size.x;
  int bottom = map.first + wrapped_texel(j + 1, map.size.y, map.wrap.y) * map.size.x;
  AlphaTexels t;
  t.index = ivec4(top + left, top + right, bottom + left, bottom + right);
  vec2 between = vec2(float(x - x_floor), float(y - y_floor));
  t.between = map.nearest ? vec2(0.0f) : between;
  return t;
}

// `texels`: their alpha in 255ths.
SHARED bool passes_cutoff(IN(AlphaMap) map, IN(vec4) texels, IN(vec2) between) {
  PRECISE float top = texels.x + (texels.y - texels.x) * between.x;
  PRECISE float bottom = texels.z + (texels.w - texels.z) * between.x;
  PRECISE float filtered = top + (bottom - top) * between.y;
  PRECISE float alpha = filtered * map.factor;
  return alpha >= map.cutoff;
}

SHARED_END
#endif
