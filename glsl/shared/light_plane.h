// SPDX-License-Identifier: MIT
// Triangles that cross the plane of a positional light: what of them lies in front, in texels. No near plane is needed.
#ifndef IZB_SHARED_LIGHT_PLANE_H
#define IZB_SHARED_LIGHT_PLANE_H
#include "shared/light.h"
SHARED_BEGIN

// A line of the grid: n.(x, y, 1) >= 0 on the side of the edge pq where the triangle's part in front of the light
// projects, whatever is behind (homogeneous edge functions, Olano and Greer 1997), and by the error of n beyond.
// `error`: of any component of p and q.
SHARED vec3 front_line(IN(LightWindow) window, IN(vec3) p, IN(vec3) q, float error, float turn, float side) {
  vec3 n = cross(p, q) * turn;
  float n_error = 2.0f * error * (norm1(p) + norm1(q) + error) + 8.0f * unit_roundoff * norm1(p) * norm1(q);
  vec2 texel = vec2(1.0f / window.window.z, 1.0f / window.window.w);
  float reach = 1.0f + abs(window.window.x) + abs(window.window.y) + 2.0f * side * (texel.x + texel.y);
  float slack = (n_error + 16.0f * unit_roundoff * norm1(n)) * reach;
  return vec3(n.x * texel.x, n.y * texel.y, n.z + n.x * window.window.x + n.y * window.window.y + slack);
}

// Bounds in texels of what of the triangle lies in front of the light (z > 0) and within `margin` texels of the grid;
// empty (low > high) if nothing does. The projection is unbounded, so it is clipped before it is dilated.
SHARED vec4 front_box(IN(LightWindow) window, IN(vec3) la, IN(vec3) lb, IN(vec3) lc, float error,
                      float margin) {
  float side = window.guard.y;
  vec3 low = min(la, min(lb, lc)) - vec3(error);
  vec3 high = max(la, max(lb, lc)) + vec3(error);
  // A point with z in (0, high.z] and x > 0 projects to x / z >= low.x / high.z, and so on.
  vec2 u = vec2(low.x < 0.0f ? -margin : (low.x / high.z - window.window.x) * window.window.z,
                high.x > 0.0f ? side + margin : (high.x / high.z - window.window.x) * window.window.z);
  vec2 v = vec2(low.y < 0.0f ? -margin : (low.y / high.z - window.window.y) * window.window.w,
                high.y > 0.0f ? side + margin : (high.y / high.z - window.window.y) * window.window.w);
  vec4 box = vec4(max(u.x, -margin), max(v.x, -margin), min(u.y, side + margin), min(v.y, side + margin));

  vec3 across = cross(lb, lc);
  float det = dot(la, across);
  float det_error =
      4.0f *
      (norm1(la) * (2.0f * error * (norm1(lb) + norm1(lc) + error) + 8.0f * unit_roundoff * norm1(lb) * norm1(lc)) +
       norm1(across) * (error + unit_roundoff * norm1(la)));
  if (!(abs(det) > det_error)) return box;  // which side is inside is not known
  float turn = det < 0.0f ? -1.0f : 1.0f;

  // Sutherland and Hodgman 1974: the box by the three lines.
  vec2 corners[8];
  vec2 kept[8];
  int count = 4;
  corners[0] = vec2(box.x, box.y);
  corners[1] = vec2(box.z, box.y);
  corners[2] = vec2(box.z, box.w);
  corners[3] = vec2(box.x, box.w);
  for (int edge = 0; edge < 3; ++edge) {
    vec3 p = edge == 0 ? lb : (edge == 1 ? lc : la);
    vec3 q = edge == 0 ? lc : (edge == 1 ? la : lb);
    vec3 line = front_line(window, p, q, error, turn, side);
    int n = 0;
    for (int i = 0; i < count; ++i) {
      vec2 here = corners[i];
      vec2 next = corners[i + 1 < count ? i + 1 : 0];
      float h = line.x * here.x + line.y * here.y + line.z;
      float h_next = line.x * next.x + line.y * next.y + line.z;
      if (h >= 0.0f) kept[n++] = here;
      if ((h >= 0.0f) != (h_next >= 0.0f)) kept[n++] = here + (next - here) * (h / (h - h_next));
    }
    count = n;
    for (int i = 0; i < n; ++i) corners[i] = kept[i];
  }
  vec4 bounds = vec4(3.0e38f, 3.0e38f, -3.0e38f, -3.0e38f);
  for (int i = 0; i < count; ++i) {
    bounds = vec4(min(bounds.x, corners[i].x), min(bounds.y, corners[i].y), max(bounds.z, corners[i].x),
                  max(bounds.w, corners[i].y));
  }
  return bounds;
}

SHARED_END
#endif
