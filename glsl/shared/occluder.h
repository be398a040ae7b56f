// SPDX-License-Identifier: MIT
// The conservative occlusion prepass (Tokuyoshi and Mizokuchi 2018): which texels of the light-space grid a triangle surely
// covers all of, and from which depth on what lies there is surely in its shadow.
#ifndef IZB_SHARED_OCCLUDER_H
#define IZB_SHARED_OCCLUDER_H
#include "shared/faces.h"
#include "shared/footprint.h"
#include "shared/occlusion.h"
SHARED_BEGIN

// Of the angle between an occluder's normal and the light: what is behind it by d along the light is behind its plane by at
// least d times that.
const float least_cosine = 0.0625f;

// In grid texels; a rasteriser that samples texels' centres fills those that are covered whole.
struct Occluder {
  vec3 p0;
  vec3 p1;
  vec3 p2;
  bool any;
};

// The triangle with its edges shifted inwards, so that around each centre within there is a whole texel; its depth is that of
// the furthest point of the texel. Triangles that are cut by the light's plane, or that it grazes, or whose corners are too
// acute, are left out: whoever is in their shadow is tested.
SHARED Occluder make_occluder(IN(LightFrame) light, IN(LightWindow) window, IN(vec3) a, IN(vec3) b, IN(vec3) c) {
  Occluder o;
  o.any = false;
  o.p0 = vec3(0.0f);
  o.p1 = vec3(0.0f);
  o.p2 = vec3(0.0f);
  float side = window.guard.y;
  vec3 la = light_position(light, a);
  vec3 lb = light_position(light, b);
  vec3 lc = light_position(light, c);
  bool positional = is_positional(light);
  if (side == 0.0f) return o;
  float vertex_norm1 = max_norm1(a, b, c);
  if (positional && min(la.z, min(lb.z, lc.z)) <= 32.0f * unit_roundoff * (vertex_norm1 + norm1(vec3(light.origin))))
    return o;

  vec3 ga = grid_position(window, light_uvd(light, la));
  vec3 gb = grid_position(window, light_uvd(light, lb));
  vec3 gc = grid_position(window, light_uvd(light, lc));
  vec2 low = vec2(min(ga.x, min(gb.x, gc.x)), min(ga.y, min(gb.y, gc.y)));
  vec2 high = vec2(max(ga.x, max(gb.x, gc.x)), max(ga.y, max(gb.y, gc.y)));
  // Most triangles of large scenes end here: they hold no whole texel, or none of the grid.
  vec2 first = max(ceil(low), vec2(0.0f));
  vec2 last = min(floor(high), vec2(side));
  if (!(last.x - first.x >= 1.0f && last.y - first.y >= 1.0f)) return o;

  vec3 w = positional ? vec3(light.origin) - a : vec3(light.to_light);
  vec3 n = cross(b - a, c - a);
  float area_error = edge_error_of(b - a, c - a);
  float length = positional ? sqrt(max(dot(la, la), max(dot(lb, lb), dot(lc, lc)))) : 1.0f;
  if (!(abs(dot(n, w)) > 2.0f * area_error * norm1(w) + least_cosine * sqrt(dot(n, n)) * length)) return o;
  if (holds_light(light, a, b, c)) return o;

  float reach = max(max(abs(low.x), abs(low.y)), max(abs(high.x), abs(high.y))) + side;
  float guard = raster_guard(light, window, a, b, c, reach, 0.0f);
  if (!(reach < 1.0e6f * side && guard < 0.25f)) return o;
  float half_width = 0.5f + guard;

  vec3 e1 = gb - ga;
  vec3 e2 = gc - ga;
  float det = e1.x * e2.y - e1.y * e2.x;
  float scale = abs(e1.x * e2.y) + abs(e1.y * e2.x);
  if (!(abs(det) > 0.0009765625f * scale)) return o;
  float turn = det < 0.0f ? -1.0f : 1.0f;
  vec2 n0 = vec2(turn * (gb.y - ga.y), turn * (ga.x - gb.x));
  vec2 n1 = vec2(turn * (gc.y - gb.y), turn * (gb.x - gc.x));
  vec2 n2 = vec2(turn * (ga.y - gc.y), turn * (gc.x - ga.x));
  if (!(well_crossing(n0, n1) && well_crossing(n1, n2) && well_crossing(n2, n0))) return o;
  vec2 ca = shifted_corner(ga, n2, n0, -half_width);
  vec2 cb = shifted_corner(gb, n0, n1, -half_width);
  vec2 cc = shifted_corner(gc, n1, n2, -half_width);
  // Shifted beyond the triangle's middle the edges make another one, turned by half a circle.
  if (!(dot(cb - ca, vec2(e1.x, e1.y)) > 0.0f)) return o;

  vec2 slope = plane_slope(e1, e2, det);
  float z_min = min(ga.z, min(gb.z, gc.z));
  float z_max = max(ga.z, max(gb.z, gc.z));
  // The last term: a depth buffer of 16 bits.
  float z_guard = raster_depth_guard(light, window, a, b, c, z_min, z_max, 0.0f) + 1.5f / 65535.0f;
  float rise = half_width * (abs(slope.x) + abs(slope.y)) + 0.0009765625f * (z_max - z_min);
  vec3 base = vec3(ga.x, ga.y, ga.z + rise + z_guard);
  o.p0 = vec3(ca.x, ca.y, depth_at(base, slope, ca.x, ca.y));
  o.p1 = vec3(cb.x, cb.y, depth_at(base, slope, cb.x, cb.y));
  o.p2 = vec3(cc.x, cc.y, depth_at(base, slope, cc.x, cc.y));
  o.any = true;
  return o;
}

// By how much a point must lie behind an occluder's depth on the grid for its height over the occluder's plane to exceed
// every bias: twice as much as least_cosine asks. Depth -1/z of a positional light: dz is at least half of dd z z, or half of z.
SHARED float hidden_margin(IN(LightFrame) light, IN(LightWindow) window, float bias, float z) {
  float along = bias * (2.0f / least_cosine);
  return (is_positional(light) ? 2.0f * along / (z * z) : along) * window.depth.y;
}

// Bounds plane_bias and quad_bias of any triangle.
SHARED float largest_bias(IN(CameraFrame) camera, IN(vec3) p, float t, float point_doubt) {
  float limit = pixel_width(camera, t) * 0.0078125f;
  return 1.01f * max(limit, (6.0f + point_doubt) * unit_roundoff * norm1(p));
}

SHARED_END
#endif
