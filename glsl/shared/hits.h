// SPDX-License-Identifier: MIT
// Where on a triangle a line hits it: the values of its three edge planes at the line are the hit's weights, up to a common
// factor. In double, since these lose most of their digits far from the triangle.
#ifndef IZB_SHARED_HITS_H
#define IZB_SHARED_HITS_H
#include "shared/alpha.h"
#include "shared/coverage.h"
SHARED_BEGIN

// A triangle's corners on its alpha map, in texels, in the order of its vertices.
struct TexelCorners {
  dvec2 a;
  dvec2 b;
  dvec2 c;
};

// Weights of a, b, c where the line from p along d meets the triangle's plane.
SHARED dvec3 line_weights(IN(vec3) a, IN(vec3) b, IN(vec3) c, IN(vec3) p, IN(dvec3) d) {
  return dvec3(edge_side(b, c, p, d), edge_side(c, a, p, d), edge_side(a, b, p, d));
}

// Where the ray of pixel position px meets it.
SHARED dvec3 camera_weights(IN(CameraFrame) camera, IN(vec2) px, IN(vec3) a, IN(vec3) b, IN(vec3) c) {
  PRECISE float qx = px.x * camera.pixel_ray.x + camera.pixel_ray.z;
  PRECISE float qy = px.y * camera.pixel_ray.y + camera.pixel_ray.w;
  if (is_perspective(camera)) return line_weights(a, b, c, vec3(0.0f), dvec3(double(qx), double(qy), -1.0));
  return line_weights(a, b, c, vec3(qx, qy, 0.0f), dvec3(0.0, 0.0, -1.0));
}

// Where the line from p to the light meets it.
SHARED dvec3 light_weights(IN(LightFrame) light, IN(vec3) p, IN(vec3) a, IN(vec3) b, IN(vec3) c) {
  dvec3 d = is_positional(light) ? dvec3(vec3(light.origin)) - dvec3(p) : dvec3(vec3(light.to_light));
  return line_weights(a, b, c, p, d);
}

SHARED dvec2 texel_of_weights(IN(TexelCorners) t, IN(dvec3) w) {
  PRECISE double x = (t.a.x * w.x + t.b.x * w.y) + t.c.x * w.z;
  PRECISE double y = (t.a.y * w.x + t.b.y * w.y) + t.c.y * w.z;
  PRECISE double sum = (w.x + w.y) + w.z;
  PRECISE double scale = 1.0 / sum;
  PRECISE double u = x * scale;
  PRECISE double v = y * scale;
  return dvec2(u, v);
}

// Over a micro-quad the weights are affine in the sample's offset, and with them the texel position times their sum.
struct HitPlanes {
  dvec3 x;
  dvec3 y;
  dvec3 sum;
};

SHARED HitPlanes hit_planes(IN(QuadPlanes) q, IN(TexelCorners) t) {
  PRECISE dvec3 x = (q.edge1 * t.a.x + q.edge2 * t.b.x) + q.edge0 * t.c.x;
  PRECISE dvec3 y = (q.edge1 * t.a.y + q.edge2 * t.b.y) + q.edge0 * t.c.y;
  PRECISE dvec3 sum = (q.edge1 + q.edge2) + q.edge0;
  HitPlanes h;
  h.x = x;
  h.y = y;
  h.sum = sum;
  return h;
}

SHARED dvec2 texel_of_sample(IN(HitPlanes) h, IN(vec2) o) {
  PRECISE double scale = 1.0 / plane_at(h.sum, o);
  PRECISE double u = plane_at(h.x, o) * scale;
  PRECISE double v = plane_at(h.y, o) * scale;
  return dvec2(u, v);
}

// As order_vertices, with what belongs to the vertices: sums of three terms depend on the order in their last bit.
SHARED void order_two_with_uvs(OUT(vec3) first, OUT(vec3) second, OUT(vec2) first_uv, OUT(vec2) second_uv) {
  bool swapped = position_less(second, first);
  vec3 kept = first;
  vec2 kept_uv = first_uv;
  first = swapped ? second : first;
  first_uv = swapped ? second_uv : first_uv;
  second = swapped ? kept : second;
  second_uv = swapped ? kept_uv : second_uv;
}

SHARED void order_with_uvs(OUT(vec3) a, OUT(vec3) b, OUT(vec3) c, OUT(vec2) uv_a, OUT(vec2) uv_b, OUT(vec2) uv_c) {
  order_two_with_uvs(a, b, uv_a, uv_b);
  order_two_with_uvs(b, c, uv_b, uv_c);
  order_two_with_uvs(a, b, uv_a, uv_b);
}

// ---- once a fragment of the light-space grid --------------------------------------------------------------------------

// Where the light's ray through a grid position meets the triangle, or at the nearest of its edges, since dilated triangles
// reach beyond theirs. `light` is the face's. Single precision: this mode is an approximation by far more than that.
SHARED dvec3 fragment_weights(IN(LightFrame) light, IN(LightWindow) window, IN(vec2) grid, IN(vec3) a, IN(vec3) b,
                              IN(vec3) c) {
  vec2 uv = vec2(grid.x / window.window.z + window.window.x, grid.y / window.window.w + window.window.y);
  vec3 la = light_position(light, a);
  vec3 lb = light_position(light, b);
  vec3 lc = light_position(light, c);
  vec3 d = vec3(uv, 1.0f);
  if (!is_positional(light)) {
    la = vec3(la.x - uv.x, la.y - uv.y, 1.0f);
    lb = vec3(lb.x - uv.x, lb.y - uv.y, 1.0f);
    lc = vec3(lc.x - uv.x, lc.y - uv.y, 1.0f);
    d = vec3(0.0f, 0.0f, 1.0f);
  }
  vec3 w = vec3(dot(cross(lb, lc), d), dot(cross(lc, la), d), dot(cross(la, lb), d));
  float turn = w.x + w.y + w.z < 0.0f ? -1.0f : 1.0f;
  vec3 kept = max(w * turn, vec3(0.0f));
  return dvec3(kept);
}

SHARED_END
#endif
