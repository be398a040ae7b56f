// SPDX-License-Identifier: MIT
// A micro-quad as each face of the cube around the light sees it. Only one near enough to the light, or across a border, is
// seen by several; it goes into each.
#ifndef IZB_SHARED_FACES_H
#define IZB_SHARED_FACES_H
#include "shared/insertion.h"
SHARED_BEGIN

// What of a micro-quad lies in one grid.
struct QuadPart {
  bool any;
  bool whole;  // all of it, and its corners can be projected
  vec3 low;    // bounds in (u, v, d); those of a part include their error
  vec3 high;
  vec2 slack;  // errors of u and v, and of d
};

SHARED QuadPart whole_quad(IN(LightFrame) light, IN(MicroQuad) m) {
  QuadPart part;
  part.any = true;
  part.whole = true;
  vec3 c0 = micro_quad_uvd(light, m, corner_offset(0));
  vec3 c1 = micro_quad_uvd(light, m, corner_offset(1));
  vec3 c2 = micro_quad_uvd(light, m, corner_offset(2));
  vec3 c3 = micro_quad_uvd(light, m, corner_offset(3));
  part.low = min(min(c0, c1), min(c2, c3));
  part.high = max(max(c0, c1), max(c2, c3));
  vec3 center = light_position(light, m.center);
  part.slack = vec2(quad_uv_error(light, m, center), quad_d_error(light, m, center));
  return part;
}

// Faces overlap by this much of their width, so that rounding loses nothing between them.
const float face_overlap = 0.00001f;

// Of a face's coordinates, positive inside the pyramid |x| <= z, |y| <= z and `slack` beyond its sides.
SHARED float pyramid_side_of(IN(vec3) p, int side, float slack) {
  float across = side < 2 ? p.x : p.y;
  return (1.0f + face_overlap) * p.z + slack + ((side & 1) == 0 ? across : -across);
}

SHARED bool well_inside(IN(vec3) p, float slack) {
  return (1.0f - face_overlap) * p.z - slack > max(abs(p.x), abs(p.y));
}

// Part f of the cube around a positional light.
SHARED QuadPart quad_part(IN(LightFrame) light, IN(MicroQuad) m, int f) {
  const int most = 12;  // corners; eight but for rounding
  vec3 corners[12];
  vec3 kept[12];
  float slack = 32.0f * unit_roundoff * (norm1(m.center) + m.extent + norm1(vec3(light.origin)));
  bool inside = true;
  float nearest = 3.0e38f;
  for (int i = 0; i < 4; ++i) {
    corners[i] = on_face(light_position(light, micro_quad_point(m, corner_offset(i))), f);
    inside = inside && well_inside(corners[i], slack);
    nearest = min(nearest, corners[i].z);
  }
  vec3 center = on_face(light_position(light, m.center), f);
  if (inside && nearest > 0.05f * center.z) return whole_quad(light_face(light, f), m);

  // Sutherland and Hodgman 1974: by the four sides of the pyramid.
  int count = 4;
  for (int side = 0; side < 4; ++side) {
    int n = 0;
    for (int i = 0; i < count; ++i) {
      vec3 here = corners[i];
      vec3 next = corners[i + 1 < count ? i + 1 : 0];
      float h = pyramid_side_of(here, side, slack);
      float h_next = pyramid_side_of(next, side, slack);
      if (h >= 0.0f && n < most) kept[n++] = here;
      if ((h >= 0.0f) != (h_next >= 0.0f) && n < most) kept[n++] = here + (next - here) * (h / (h - h_next));
    }
    count = n;
    for (int i = 0; i < n; ++i) corners[i] = kept[i];
  }
  QuadPart part;
  part.any = count > 0;
  part.whole = false;
  part.slack = vec2(0.0f);
  const float border = 1.0f + 2.0f * face_overlap;
  vec2 low = vec2(border);
  vec2 high = vec2(-border);
  float z_low = 3.0e38f;
  float z_high = slack;
  for (int i = 0; i < count; ++i) {
    float z = corners[i].z;
    bool everywhere = z < 16.0f * slack;  // as near to the light as its own error
    float error = everywhere ? 4.0f : 4.0f * slack / z;
    vec2 uv = everywhere ? vec2(0.0f) : vec2(corners[i].x / z, corners[i].y / z);
    low = min(low, uv - error);
    high = max(high, uv + error);
    z_low = min(z_low, z);
    z_high = max(z_high, z + slack);
  }
  low = max(low, vec2(-border));
  high = min(high, vec2(border));
  // The nearest depth only scales the depths, and would squeeze all others.
  part.low = vec3(low.x, low.y, -1.0f / max(z_low, 0.05f * z_high));
  part.high = vec3(high.x, high.y, -1.0f / z_high);
  return part;
}

// Texels by which a point of the part may be off.
SHARED float quad_guard(IN(LightWindow) window, IN(QuadPart) part) {
  return max(window.guard.x, texel_guard(window, part.slack.x));
}

// The part's outline on the grid: of one that is not whole, its box.
SHARED QuadOnGrid part_on_grid(IN(LightFrame) face, IN(LightWindow) window, IN(MicroQuad) m, IN(QuadPart) part) {
  if (part.whole) {
    QuadOnGrid whole = project_quad(face, window, m);
    whole.deepest += max(depth_guard(window, part.slack.y) - window.depth.z, 0.0f);
    return whole;
  }
  vec3 low = grid_position(window, part.low);
  vec3 high = grid_position(window, part.high);
  QuadOnGrid q;
  q.corner0 = vec3(low.x, low.y, high.z);
  q.corner1 = vec3(high.x, low.y, high.z);
  q.corner2 = vec3(high.x, high.y, high.z);
  q.corner3 = vec3(low.x, high.y, high.z);
  q.deepest = high.z + window.depth.z;
  return q;
}

SHARED_END
#endif
