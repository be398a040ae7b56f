// SPDX-License-Identifier: MIT
// Into which texels of the light-space grid a micro-quad goes (6.1).
#ifndef IZB_SHARED_INSERTION_H
#define IZB_SHARED_INSERTION_H
#include "shared/bounds.h"
#include "shared/micro_quad.h"
SHARED_BEGIN

// A point of the micro-quad on the grid. For a positional light a point nearer to the light's plane than 1/20 of the
// centre's distance is drawn toward the centre: its projection would leave every window.
SHARED vec3 micro_quad_uvd(IN(LightFrame) light, IN(MicroQuad) m, IN(vec2) o) {
  vec3 p = light_position(light, micro_quad_point(m, o));
  if (is_positional(light)) {
    vec3 center = light_position(light, m.center);
    float least = 0.05f * center.z;
    if (p.z < least) p = center + (p - center) * ((center.z - least) / (center.z - p.z));
  }
  return light_uvd(light, p);
}

// Least depth of a point of the micro-quad: each is within `extent` of the centre.
SHARED float least_depth(IN(MicroQuad) m, IN(vec3) p_ls) { return max(p_ls.z - m.extent, 0.05f * p_ls.z); }

// uv_error and d_error for any point of the micro-quad: such a point is up to `extent` further out, and for a positional
// light nearer, where the division magnifies.
SHARED float quad_uv_error(IN(LightFrame) light, IN(MicroQuad) m, IN(vec3) p_ls) {
  float moved = 16.0f * unit_roundoff * (norm1(m.center) + m.extent + norm1(vec3(light.origin)));
  if (!is_positional(light)) return moved;
  float z = least_depth(m, p_ls);
  return 2.0f * moved / z * (1.0f + (max(abs(p_ls.x), abs(p_ls.y)) + m.extent) / z);
}

SHARED float quad_d_error(IN(LightFrame) light, IN(MicroQuad) m, IN(vec3) p_ls) {
  float moved = 16.0f * unit_roundoff * (norm1(m.center) + m.extent + norm1(vec3(light.origin)));
  if (!is_positional(light)) return moved;
  float z = least_depth(m, p_ls);
  return 2.0f * moved / (z * z);
}

// The corners: offsets (-1/2, -1/2), (1/2, -1/2), (1/2, 1/2), (-1/2, 1/2).
SHARED vec2 corner_offset(int i) {
  return vec2(i == 1 || i == 2 ? 0.5f : -0.5f, i >= 2 ? 0.5f : -0.5f);
}

struct QuadOnGrid {
  vec3 corner0;
  vec3 corner1;
  vec3 corner2;
  vec3 corner3;
  float deepest;  // largest depth of any point, guard included
};

SHARED QuadOnGrid project_quad(IN(LightFrame) light, IN(LightWindow) window, IN(MicroQuad) m) {
  QuadOnGrid q;
  q.corner0 = grid_position(window, micro_quad_uvd(light, m, corner_offset(0)));
  q.corner1 = grid_position(window, micro_quad_uvd(light, m, corner_offset(1)));
  q.corner2 = grid_position(window, micro_quad_uvd(light, m, corner_offset(2)));
  q.corner3 = grid_position(window, micro_quad_uvd(light, m, corner_offset(3)));
  q.deepest = max(max(q.corner0.z, q.corner1.z), max(q.corner2.z, q.corner3.z)) + window.depth.z;
  return q;
}

// ---- approximate: a row of nodes along one axis ----------------------------------------------------------------------

// Half the micro-quad's longest axis in light space, as a sample offset: of the two through the middles of opposite sides and
// the two diagonals the longest, in texels.
SHARED vec2 longest_axis(IN(QuadOnGrid) q, OUT(float) length_texels) {
  vec2 d0 = vec2(q.corner2.x - q.corner0.x, q.corner2.y - q.corner0.y);
  vec2 d1 = vec2(q.corner1.x - q.corner3.x, q.corner1.y - q.corner3.y);
  vec2 x = (d0 + d1) * 0.5f;
  vec2 y = (d0 - d1) * 0.5f;
  float lx = dot(x, x);
  float ly = dot(y, y);
  float l0 = dot(d0, d0);
  float l1 = dot(d1, d1);
  // A diagonal only where it is the long way: a square's is not.
  vec2 axis = lx >= ly ? vec2(0.5f, 0.0f) : vec2(0.0f, 0.5f);
  float most = max(lx, ly);
  if (l0 > 2.5f * most) {
    axis = vec2(0.5f, 0.5f);
    most = l0;
  }
  if (l1 > 2.5f * max(lx, ly) && l1 > l0) {
    axis = vec2(0.5f, -0.5f);
    most = l1;
  }
  length_texels = sqrt(most);
  return axis;
}

// ---- exact: every texel that the micro-quad touches ------------------------------------------------------------------

// Widens [low, high] by what of the segment pq lies in the rows [bottom, top].
SHARED void add_segment(IN(vec3) p, IN(vec3) q, float bottom, float top, OUT(float) low, OUT(float) high) {
  float y0 = min(p.y, q.y);
  float y1 = max(p.y, q.y);
  if (y1 < bottom || y0 > top) return;
  float slope = y1 > y0 ? (q.x - p.x) / (q.y - p.y) : 0.0f;
  float x0 = y1 > y0 ? p.x + (clamp(bottom, y0, y1) - p.y) * slope : p.x;
  float x1 = y1 > y0 ? p.x + (clamp(top, y0, y1) - p.y) * slope : q.x;
  float left = max(min(x0, x1), min(p.x, q.x));
  float right = min(max(x0, x1), max(p.x, q.x));
  low = min(low, left);
  high = max(high, right);
}

SHARED int clamped_texel(float x, int last) { return int(clamp(floor(x), 0.0f, float(last))); }

// First and last row of texels that the quad touches, `guard` texels around it included.
SHARED ivec2 quad_rows(IN(QuadOnGrid) q, float guard, int last) {
  float low = min(min(q.corner0.y, q.corner1.y), min(q.corner2.y, q.corner3.y));
  float high = max(max(q.corner0.y, q.corner1.y), max(q.corner2.y, q.corner3.y));
  return ivec2(clamped_texel(low - guard, last), clamped_texel(high + guard, last));
}

// First and last texel of a row; x > y: none.
SHARED ivec2 quad_columns(IN(QuadOnGrid) q, float guard, int last, int row) {
  float low = 3.0e38f;
  float high = -3.0e38f;
  // The border rows also hold what lies outside the grid.
  float bottom = row == 0 ? -3.0e38f : float(row) - guard;
  float top = row == last ? 3.0e38f : float(row + 1) + guard;
  add_segment(q.corner0, q.corner1, bottom, top, low, high);
  add_segment(q.corner1, q.corner2, bottom, top, low, high);
  add_segment(q.corner2, q.corner3, bottom, top, low, high);
  add_segment(q.corner3, q.corner0, bottom, top, low, high);
  if (low > high) return ivec2(1, 0);
  return ivec2(clamped_texel(low - guard, last), clamped_texel(high + guard, last));
}

SHARED_END
#endif
