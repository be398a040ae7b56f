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

// ---- texels that answer for the whole micro-quad ---------------------------------------------------------------------

// A triangle visits each texel whose centre it comes within `reach` of (the raster's dilation) in both axes, so a node
// answers for all points that near to its texel's centre. With a reach of 1/2 that is its texel, and the cover below is
// exact insertion; with the paper's 1 texel every second texel will do. Nodes stand in rows along the micro-quad's long axis.

SHARED int clamped_texel(float x, int last) { return int(clamp(floor(x), 0.0f, float(last))); }

// Texels of one axis whose reaches together hold an interval; where they may be only `most`, as many at even distances.
struct Run {
  int start;
  int span;
  int needed;
  int count;
};

SHARED Run make_run(float low, float high, float reach, int last, int most) {
  int step = int(2.0f * reach);
  int first = clamped_texel(low + (reach - 0.5f), last);
  float beyond = min(high, float(last + 1)) - (float(first) + 0.5f + reach);
  Run r;
  r.needed = low > high ? 0 : 1 + int(ceil(max(beyond, 0.0f) / float(step)));
  r.count = min(r.needed, most);
  r.start = first - step / 2;
  r.span = r.count * step;
  if (r.count < r.needed) {
    r.start = clamped_texel(low, last);
    r.span = clamped_texel(high, last) + 1 - r.start;
  }
  return r;
}

SHARED int run_texel(IN(Run) r, int i, int last) { return min(r.start + (2 * i + 1) * r.span / (2 * r.count), last); }

// Widens [low, high] by what of the segment pq lies in the rows [bottom, top].
SHARED void add_segment(IN(vec2) p, IN(vec2) q, float bottom, float top, OUT(float) low, OUT(float) high) {
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

struct Cover {
  vec2 corner0;  // in texels; x and y exchanged where the long axis is x
  vec2 corner1;
  vec2 corner2;
  vec2 corner3;
  bool exchanged;
  float reach;
  float guard;  // texels by which points may be off
  int last;
  float long_side;  // texels
  Run rows;
};

// At most `most` rows.
SHARED Cover make_cover(IN(QuadOnGrid) q, float reach, float guard, int last, int most) {
  Cover c;
  c.corner0 = vec2(q.corner0.x, q.corner0.y);
  c.corner1 = vec2(q.corner1.x, q.corner1.y);
  c.corner2 = vec2(q.corner2.x, q.corner2.y);
  c.corner3 = vec2(q.corner3.x, q.corner3.y);
  vec2 low = min(min(c.corner0, c.corner1), min(c.corner2, c.corner3));
  vec2 high = max(max(c.corner0, c.corner1), max(c.corner2, c.corner3));
  c.exchanged = high.x - low.x > high.y - low.y;
  if (c.exchanged) {
    c.corner0 = vec2(c.corner0.y, c.corner0.x);
    c.corner1 = vec2(c.corner1.y, c.corner1.x);
    c.corner2 = vec2(c.corner2.y, c.corner2.x);
    c.corner3 = vec2(c.corner3.y, c.corner3.x);
  }
  c.reach = reach;
  c.guard = guard;
  c.last = last;
  c.long_side = max(high.x - low.x, high.y - low.y);
  c.rows = make_run((c.exchanged ? low.x : low.y) - guard, (c.exchanged ? high.x : high.y) + guard, reach, last, most);
  return c;
}

// At most `most` nodes in a row.
SHARED Run cover_row(IN(Cover) c, int row, int most) {
  float low = 3.0e38f;
  float high = -3.0e38f;
  // Rows that answer for a border also hold what lies outside the grid.
  float center = float(row) + 0.5f;
  float bottom = center - c.reach <= 0.0f ? -3.0e38f : center - c.reach - c.guard;
  float top = center + c.reach >= float(c.last + 1) ? 3.0e38f : center + c.reach + c.guard;
  add_segment(c.corner0, c.corner1, bottom, top, low, high);
  add_segment(c.corner1, c.corner2, bottom, top, low, high);
  add_segment(c.corner2, c.corner3, bottom, top, low, high);
  add_segment(c.corner3, c.corner0, bottom, top, low, high);
  return make_run(low - c.guard, high + c.guard, c.reach, c.last, most);
}

SHARED ivec2 cover_texel(IN(Cover) c, int row, IN(Run) run, int i) {
  int column = run_texel(run, i, c.last);
  return c.exchanged ? ivec2(row, column) : ivec2(column, row);
}

SHARED_END
#endif
