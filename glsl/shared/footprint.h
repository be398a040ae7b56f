// SPDX-License-Identifier: MIT
// Conservative rasterisation in a geometry shader (Hasselgren, Akenine-Moeller and Ohlsson 2005): a polygon that covers
// the centre of every texel whose square, grown by a guard, touches the triangle's projection. Of three such polygons the
// smallest is taken: the triangle with its edges shifted outwards (their second algorithm), a box along its longest edge,
// and its axis-aligned box. So the spikes of acute corners never cost more than a box; the fragment shader also rejects
// what lies outside the dilated axis-aligned box.
#ifndef IZB_SHARED_FOOTPRINT_H
#define IZB_SHARED_FOOTPRINT_H
#include "shared/light_plane.h"
SHARED_BEGIN

struct Footprint {
  vec4 box;   // dilated bounds in texels: min, max
  vec3 p0;    // corners in texels, and depth; a triangle strip
  vec3 p1;
  vec3 p2;
  vec3 p3;
  int count;  // corners: 0 (nothing), 3 or 4
  // The depth at a texel's centre, by depth_at: at most the triangle's anywhere in the square that is swept over it.
  vec3 base;
  vec2 slope;
  // Half the side of the square that a rasteriser must sweep over the bare triangle to do without the polygon; without
  // bounds where that must not be left to it.
  float square;
};

// Depth at (x, y) of the plane through p0 with the given slopes.
SHARED float depth_at(IN(vec3) p0, IN(vec2) slope, float x, float y) {
  return p0.z + slope.x * (x - p0.x) + slope.y * (y - p0.y);
}

// Where the edges that meet in p, shifted outwards by `half_width` texels in both axes, cross. n_in and n_out are the
// outward normals of the edge that ends in p and of the one that begins there.
SHARED vec2 shifted_corner(IN(vec3) p, IN(vec2) n_in, IN(vec2) n_out, float half_width) {
  float k_in = half_width * (abs(n_in.x) + abs(n_in.y));
  float k_out = half_width * (abs(n_out.x) + abs(n_out.y));
  float det = n_in.x * n_out.y - n_in.y * n_out.x;
  return vec2(p.x + (k_in * n_out.y - k_out * n_in.y) / det, p.y + (n_in.x * k_out - n_out.x * k_in) / det);
}

// Are two edge normals far enough from parallel (sine of at least 1/16) for their crossing to be accurate and near?
SHARED bool well_crossing(IN(vec2) m, IN(vec2) n) {
  float det = m.x * n.y - m.y * n.x;
  return det * det > 0.00390625f * dot(m, m) * dot(n, n);
}

// Texels by which vertices on the grid may be off, more than `own`: two of the rasteriser's sub-pixel steps (8 bits), the vertices'
// error, and what viewport transform, clipping and edge set-up lose on coordinates as large as `reach`.
SHARED float raster_guard(IN(LightFrame) light, IN(LightWindow) window, IN(vec3) a, IN(vec3) b, IN(vec3) c, float reach, float own) {
  float uv = max(uv_error(light, a, light_position(light, a)),
                 max(uv_error(light, b, light_position(light, b)), uv_error(light, c, light_position(light, c))));
  return own + 0.0078125f + uv * max(window.window.z, window.window.w) + 16.0f * unit_roundoff * reach;
}

// The same of the depth of a triangle with depths from z_min to z_max.
SHARED float raster_depth_guard(IN(LightFrame) light, IN(LightWindow) window, IN(vec3) a, IN(vec3) b, IN(vec3) c, float z_min,
                                float z_max, float own) {
  float d_slack = max(d_error(light, a, light_position(light, a)),
                      max(d_error(light, b, light_position(light, b)), d_error(light, c, light_position(light, c)))) *
                  window.depth.y;
  return own + d_slack + 64.0f * unit_roundoff * (1.0f + max(abs(z_min), abs(z_max)));
}

// Of the plane through two edges on the grid; det: their determinant.
SHARED vec2 plane_slope(IN(vec3) e1, IN(vec3) e2, float det) {
  return vec2((e1.z * e2.y - e2.z * e1.y) / det, (e2.z * e1.x - e1.z * e2.x) / det);
}

// half_texel: half the side of the square that is swept over the triangle: 1/2, or more for over-conservative rasters.
SHARED Footprint make_footprint(IN(LightFrame) light, IN(LightWindow) window, IN(vec3) a, IN(vec3) b, IN(vec3) c,
                                float half_texel) {
  Footprint f;
  f.count = 0;
  f.square = 3.0e38f;
  f.box = vec4(0.0f);
  f.p0 = vec3(0.0f);
  f.p1 = vec3(0.0f);
  f.p2 = vec3(0.0f);
  f.p3 = vec3(0.0f);
  f.base = vec3(0.0f);
  f.slope = vec2(0.0f);
  float side = window.guard.y;
  // A triangle with two equal vertices casts nothing; nor does any before there is a receiver.
  if (a == b || b == c || c == a || window.guard.y == 0.0f) return f;

  vec3 la = light_position(light, a);
  vec3 lb = light_position(light, b);
  vec3 lc = light_position(light, c);
  bool crosses = false;
  float z_error = 0.0f;
  if (is_positional(light)) {
    // z of light_position is off by less than this. Behind the light's plane nothing is cast forward.
    z_error = 8.0f * unit_roundoff * (max(norm1(a), max(norm1(b), norm1(c))) + norm1(vec3(light.origin)));
    if (max(la.z, max(lb.z, lc.z)) < -z_error) return f;
    crosses = min(la.z, min(lb.z, lc.z)) <= 2.0f * z_error;
  }
  if (crosses) {
    float margin = 2.0f + window.guard.x + half_texel;
    vec4 front = front_box(window, la, lb, lc, z_error, margin);
    f.box = vec4(max(front.x - margin, -1.0f), max(front.y - margin, -1.0f), min(front.z + margin, side + 1.0f),
                 min(front.w + margin, side + 1.0f));
    if (f.box.x >= f.box.z || f.box.y >= f.box.w) return f;
    f.p0 = vec3(f.box.x, f.box.y, 0.0f);  // depth 0: in front of all
    f.p1 = vec3(f.box.z, f.box.y, 0.0f);
    f.p2 = vec3(f.box.x, f.box.w, 0.0f);
    f.p3 = vec3(f.box.z, f.box.w, 0.0f);
    f.count = 4;
    return f;
  }

  vec3 ga = grid_position(window, light_uvd(light, la));
  vec3 gb = grid_position(window, light_uvd(light, lb));
  vec3 gc = grid_position(window, light_uvd(light, lc));
  vec2 low = vec2(min(ga.x, min(gb.x, gc.x)), min(ga.y, min(gb.y, gc.y)));
  vec2 high = vec2(max(ga.x, max(gb.x, gc.x)), max(ga.y, max(gb.y, gc.y)));

  float reach = max(max(abs(low.x), abs(low.y)), max(abs(high.x), abs(high.y))) + side;
  float guard = raster_guard(light, window, a, b, c, reach, window.guard.x);  // with the receivers' own
  float half_width = half_texel + guard;
  f.box = vec4(low.x - half_width, low.y - half_width, high.x + half_width, high.y + half_width);
  // Written so that overflow (NaN, infinity) keeps the triangle and takes the whole grid.
  bool finite = reach < 1.0e6f * side && half_width < side;
  if (!finite) f.box = vec4(-1.0f, -1.0f, side + 1.0f, side + 1.0f);
  if (f.box.x >= side || f.box.y >= side || f.box.z <= 0.0f || f.box.w <= 0.0f) return f;
  vec4 cut = vec4(max(f.box.x, -1.0f), max(f.box.y, -1.0f), min(f.box.z, side + 1.0f), min(f.box.w, side + 1.0f));

  // Depth: every fragment's must be at most that of the triangle anywhere in the fragment's swept square, or early z
  // would cull true occluders. The plane less its change over that square, or the triangle's nearest depth.
  float z_min = min(ga.z, min(gb.z, gc.z));
  float z_max = max(ga.z, max(gb.z, gc.z));
  vec3 e1 = gb - ga;
  vec3 e2 = gc - ga;
  float det = e1.x * e2.y - e1.y * e2.x;
  float scale = abs(e1.x * e2.y) + abs(e1.y * e2.x);
  vec2 slope = plane_slope(e1, e2, det);
  float z_guard = raster_depth_guard(light, window, a, b, c, z_min, z_max, window.depth.z);
  float drop = half_width * (abs(slope.x) + abs(slope.y)) + 0.0009765625f * (z_max - z_min);
  bool sloped = finite && abs(det) > 0.0009765625f * scale && drop < z_max - z_min;
  vec3 base = sloped ? vec3(ga.x, ga.y, ga.z - drop - z_guard) : vec3(ga.x, ga.y, z_min - z_guard);
  if (!sloped) slope = vec2(0.0f);

  // Hardware snaps the bare triangle: something must be left of it (its area changes by half of this at most), its plane
  // must be exact enough for hardware_offset_factor, wherever in the grid it is evaluated from; and nothing may be clipped.
  float vertex_guard = guard - window.guard.x;
  float extent = abs(e1.x) + abs(e1.y) + abs(e2.x) + abs(e2.y);
  float least_det = 4.0f * vertex_guard * extent + 16.0f * vertex_guard * vertex_guard +
                    64.0f * unit_roundoff * extent * extent * (extent + side);
  if (finite && abs(det) > least_det && reach - side < 32000.0f) f.square = half_width;

  // The three polygons and their areas.
  vec2 cut_size = vec2(cut.z - cut.x, cut.w - cut.y);
  float box_area = cut_size.x * cut_size.y;

  float turn = det < 0.0f ? -1.0f : 1.0f;
  vec2 n0 = vec2(turn * (gb.y - ga.y), turn * (ga.x - gb.x));
  vec2 n1 = vec2(turn * (gc.y - gb.y), turn * (gb.x - gc.x));
  vec2 n2 = vec2(turn * (ga.y - gc.y), turn * (gc.x - ga.x));
  vec2 ca = shifted_corner(ga, n2, n0, half_width);
  vec2 cb = shifted_corner(gb, n0, n1, half_width);
  vec2 cc = shifted_corner(gc, n1, n2, half_width);
  bool shiftable = finite && well_crossing(n0, n1) && well_crossing(n1, n2) && well_crossing(n2, n0);
  float shifted_area = 0.5f * abs((cb.x - ca.x) * (cc.y - ca.y) - (cb.y - ca.y) * (cc.x - ca.x));

  float l0 = dot(n0, n0);
  float l1 = dot(n1, n1);
  float l2 = dot(n2, n2);
  vec2 across = l0 >= l1 && l0 >= l2 ? n0 : (l1 >= l2 ? n1 : n2);
  across = across * (1.0f / sqrt(dot(across, across)));
  vec2 along = vec2(-across.y, across.x);
  vec2 rb = vec2(gb.x - ga.x, gb.y - ga.y);
  vec2 rc = vec2(gc.x - ga.x, gc.y - ga.y);
  vec3 s = vec3(0.0f, dot(along, rb), dot(along, rc));
  vec3 t = vec3(0.0f, dot(across, rb), dot(across, rc));
  // `along` is a unit vector only up to rounding (32u with the worst square root and division that GLSL allows).
  float grow = half_width * (abs(along.x) + abs(along.y)) + 0.000004f * (abs(s.y) + abs(s.z) + abs(t.y) + abs(t.z));
  float s_min = min(s.x, min(s.y, s.z)) - grow;
  float s_max = max(s.x, max(s.y, s.z)) + grow;
  float t_min = min(t.x, min(t.y, t.z)) - grow;
  float t_max = max(t.x, max(t.y, t.z)) + grow;
  float oriented_area = (s_max - s_min) * (t_max - t_min);

  // A quad is drawn as two triangles, which enter the blocks along their diagonal twice: it must be half as large.
  bool take_shifted = shiftable && shifted_area <= 2.0f * box_area && !(2.0f * oriented_area < shifted_area);
  bool take_oriented = finite && !take_shifted && oriented_area < box_area;
  vec2 q0 = vec2(cut.x, cut.y);
  vec2 q1 = vec2(cut.z, cut.y);
  vec2 q2 = vec2(cut.x, cut.w);
  vec2 q3 = vec2(cut.z, cut.w);
  vec2 origin = vec2(ga.x, ga.y);
  if (take_oriented) {
    q0 = origin + along * s_min + across * t_min;
    q1 = origin + along * s_max + across * t_min;
    q2 = origin + along * s_min + across * t_max;
    q3 = origin + along * s_max + across * t_max;
  }
  if (take_shifted) {
    q0 = ca;
    q1 = cb;
    q2 = cc;
  }
  f.p0 = vec3(q0.x, q0.y, depth_at(base, slope, q0.x, q0.y));
  f.p1 = vec3(q1.x, q1.y, depth_at(base, slope, q1.x, q1.y));
  f.p2 = vec3(q2.x, q2.y, depth_at(base, slope, q2.x, q2.y));
  f.p3 = vec3(q3.x, q3.y, depth_at(base, slope, q3.x, q3.y));
  f.base = base;
  f.slope = slope;
  f.count = take_shifted ? 3 : 4;
  return f;
}

// ---- hardware that rasterises conservatively by itself ---------------------------------------------------------------

// A vertex for it: in texels, and nearer than its own depth by that depth's error. Behind a positional light any place
// will do, since such a triangle is not left to hardware.
SHARED vec3 hardware_vertex(IN(LightFrame) light, IN(LightWindow) window, IN(vec3) p_vs) {
  vec3 p = light_position(light, p_vs);
  if (is_positional(light) && p.z <= 0.0f) return vec3(0.0f);
  vec3 g = grid_position(window, light_uvd(light, p));
  float guard =
      window.depth.z + d_error(light, p_vs, p) * window.depth.y + 64.0f * unit_roundoff * (1.0f + abs(g.z));
  return vec3(g.x, g.y, g.z - guard);
}

// The factor of glPolygonOffset, times the larger slope of the snapped plane, that lowers the depth at a texel's centre to
// that of any point of the triangle within the square of half side `square` about it: the depth changes by the sum of both
// slopes times that, at most. An eighth is for the plane's own rounding.
SHARED float hardware_offset_factor(float square) { return -(2.0f * square + 0.125f); }

SHARED_END
#endif
