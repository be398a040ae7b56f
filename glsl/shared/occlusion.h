// SPDX-License-Identifier: MIT
// Does a triangle stand between a point and the light? The paper's four planes (section 4: three edges with the light,
// and the triangle itself), at one sample, in view space.
//
// The answer is defined by `occludes` in double precision. `classify` gives the same answer in single precision
// wherever its forward error bounds allow, and says `pair_unsure` elsewhere; those few pairs are settled in double. So
// the mask depends on nothing but the pairs: not on grid, raster path, order, or thread count, as long as no pair that
// matters is missed.
#ifndef IZB_SHARED_OCCLUSION_H
#define IZB_SHARED_OCCLUSION_H
#include "shared/light.h"
SHARED_BEGIN

const int pair_out = 0;
const int pair_in = 1;
const int pair_unsure = 2;

// The receiver lies on its own plane, and on coplanar duplicates of it, only up to rounding: its eye distance and its
// two products carry 3u |P|, each vertex as much of its own. An occluder must be nearer to the light than that, or the
// plane test is a coin toss. Never more than 1/128 pixel, as far as the receiver's own rounding allows.
SHARED float plane_bias(IN(CameraFrame) camera, IN(vec3) p, float eye_distance, float vertex_norm1) {
  PRECISE float rounding = 8.0f * unit_roundoff * (norm1(p) + vertex_norm1);
  PRECISE float limit = pixel_width(camera, eye_distance) * 0.0078125f;
  PRECISE float own = 4.0f * unit_roundoff * norm1(p);
  return min(rounding, max(limit, own));
}

SHARED float max_norm1(IN(vec3) a, IN(vec3) b, IN(vec3) c) { return max(norm1(a), max(norm1(b), norm1(c))); }

// ---- the definition, in double ----------------------------------------------------------------------------------

SHARED bool position_less(IN(vec3) a, IN(vec3) b) {
  if (a.x != b.x) return a.x < b.x;
  if (a.y != b.y) return a.y < b.y;
  return a.z < b.z;
}

// det(a - p, b - a, d): on which side of the plane through edge ab and the light p lies. Rounding grows with the edge, not
// with the square of the distance as det(a - p, b - p, d) would have it. Vertices are taken in the order of their positions,
// so that the two triangles of a shared edge get the same number with opposite signs: a point on the edge is inside at
// least one of them.
SHARED double edge_side(IN(vec3) a, IN(vec3) b, IN(vec3) p, IN(dvec3) d) {
  bool swapped = position_less(b, a);
  vec3 first = swapped ? b : a;
  vec3 second = swapped ? a : b;
  dvec3 u = dvec3(first) - dvec3(p);
  dvec3 v = dvec3(second) - dvec3(first);
  PRECISE double cx = u.y * v.z - u.z * v.y;
  PRECISE double cy = u.z * v.x - u.x * v.z;
  PRECISE double cz = u.x * v.y - u.y * v.x;
  PRECISE double det = (cx * d.x + cy * d.y) + cz * d.z;
  return swapped ? -det : det;
}

// A plane that a positional light lies in, as far as can be told, casts nothing: on which side the light is would be a matter
// of rounding, and with it whether all that lies behind is dark. As far as can be told: within 1/64 of a pixel as wide as at the
// light (axis_x.w, with the light's own rounding), and the vertices' rounding.
SHARED bool holds_light(IN(LightFrame) light, IN(vec3) a, IN(vec3) b, IN(vec3) c) {
  if (!is_positional(light)) return false;
  PRECISE float band = light.axis_x.w + 16.0f * unit_roundoff * max_norm1(a, b, c);
  // Single precision tells for nearly all, with room to spare.
  vec3 to_light = vec3(light.origin) - a;
  vec3 n = cross(b - a, c - a);
  float size = norm1(b - a) * norm1(c - a);
  if (abs(dot(n, to_light)) > 2.0f * band * norm1(n) + 32.0f * unit_roundoff * size * norm1(to_light)) return false;
  dvec3 e1 = dvec3(b) - dvec3(a);
  dvec3 e2 = dvec3(c) - dvec3(a);
  dvec3 w = dvec3(vec3(light.origin)) - dvec3(a);
  PRECISE double nx = e1.y * e2.z - e1.z * e2.y;
  PRECISE double ny = e1.z * e2.x - e1.x * e2.z;
  PRECISE double nz = e1.x * e2.y - e1.y * e2.x;
  PRECISE double side = (nx * w.x + ny * w.y) + nz * w.z;
  PRECISE double length2 = (nx * nx + ny * ny) + nz * nz;
  PRECISE double side2 = side * side;
  PRECISE double band2 = double(band) * double(band) * length2;
  return side2 <= band2;
}

SHARED bool occludes(IN(CameraFrame) camera, IN(LightFrame) light, IN(vec3) a, IN(vec3) b, IN(vec3) c, IN(vec3) p,
                     float eye_distance) {
  dvec3 e1 = dvec3(b) - dvec3(a);
  dvec3 e2 = dvec3(c) - dvec3(a);
  PRECISE double nx = e1.y * e2.z - e1.z * e2.y;
  PRECISE double ny = e1.z * e2.x - e1.x * e2.z;
  PRECISE double nz = e1.x * e2.y - e1.y * e2.x;
  bool positional = is_positional(light);
  dvec3 from_plane = positional ? dvec3(vec3(light.origin)) - dvec3(a) : dvec3(vec3(light.to_light));
  PRECISE double side = (nx * from_plane.x + ny * from_plane.y) + nz * from_plane.z;
  // side == 0: edge-on to the light, or there is no plane; such a triangle casts nothing.
  double sign = side > 0.0 ? 1.0 : -1.0;

  dvec3 q = dvec3(a) - dvec3(p);
  PRECISE double height = ((nx * q.x + ny * q.y) + nz * q.z) * sign;
  PRECISE double length2 = (nx * nx + ny * ny) + nz * nz;
  double bias = double(plane_bias(camera, p, eye_distance, max_norm1(a, b, c)));
  PRECISE double height2 = height * height;
  PRECISE double bias2 = bias * bias * length2;

  dvec3 d = positional ? dvec3(vec3(light.origin)) - dvec3(p) : dvec3(vec3(light.to_light));
  double s0 = edge_side(a, b, p, d) * sign;
  double s1 = edge_side(b, c, p, d) * sign;
  double s2 = edge_side(c, a, p, d) * sign;
  return side != 0.0 && !holds_light(light, a, b, c) && height > 0.0 && height2 > bias2 && s0 >= 0.0 && s1 >= 0.0 && s2 >= 0.0;
}

// ---- the same in single precision, with its error bounds ----------------------------------------------------------

// A triangle's planes through its corner a, and what bounds their rounding. Points are taken relative to a, so that errors
// grow with the distance between triangle and receiver, not with that from the camera.
struct TrianglePlanes {
  vec3 corner;        // a
  vec3 edge0;         // normals of the planes through an edge and the light, not unit length: ab,
  vec3 edge1;         // bc,
  vec3 edge2;         // ca
  float offset1;      // the plane of bc does not hold a: value = dot(edge1, p - a) - offset1
  vec3 edge_error;    // |error of an edge's value| <= edge_error * |p - a|_1 (bc: + extent)
  vec3 plane;         // unit normal of the triangle, turned towards the light
  float plane_error;  // |error of the height| <= plane_error * |p - a|_1
  float extent;       // |b - a|_1
  float vertex_norm1; // largest |v|_1
  bool sided;         // false: the sign of the plane at the light is within its own error
};

// The plane through an edge e and the light has the normal n = e x w, w towards the light. With a = |e|_inf and
// b = |w|_inf each component of n is below 2ab and off by at most 8u ab (two rounded differences, two products, one
// difference); the value dot(n, q) for q = p - a by at most 8u ab |q|_1 from that and 8u ab |q|_1 from the difference,
// the products and the sums; offset1 adds as much with |b - a|_1 in place of |q|_1, and its difference 2u ab. 18, rounded
// up to 24.
SHARED float edge_error_of(IN(vec3) e, IN(vec3) w) {
  float a = max(abs(e.x), max(abs(e.y), abs(e.z)));
  float b = max(abs(w.x), max(abs(w.y), abs(w.z)));
  return 24.0f * unit_roundoff * a * b;
}

SHARED TrianglePlanes make_planes(IN(LightFrame) light, IN(vec3) a, IN(vec3) b, IN(vec3) c) {
  TrianglePlanes t;
  bool positional = is_positional(light);
  vec3 wa = positional ? vec3(light.origin) - a : vec3(light.to_light);
  vec3 wb = positional ? vec3(light.origin) - b : vec3(light.to_light);
  vec3 eab = b - a;
  vec3 ebc = c - b;
  vec3 eca = a - c;
  t.corner = a;
  t.edge0 = cross(eab, wa);
  t.edge1 = cross(ebc, wb);
  t.edge2 = cross(eca, wa);
  t.offset1 = dot(t.edge1, eab);
  t.edge_error = vec3(edge_error_of(eab, wa), edge_error_of(ebc, wb), edge_error_of(eca, wa));
  t.extent = norm1(eab);
  vec3 n = cross(eab, -eca);
  float area_error = edge_error_of(eab, eca);
  float side = dot(n, wa);
  float length2 = dot(n, n);
  // Denormals keep no relative accuracy; what overflows to infinity would make the plane 0 and all heights too low.
  t.sided = abs(side) > 2.0f * area_error * norm1(wa) && length2 > 1.0e-30f && length2 < 1.0e37f;
  float scale = 1.0f / sqrt(length2);
  t.plane = n * (side < 0.0f ? -scale : scale);
  // The unit normal is off by area_error * scale and a few u from scaling.
  t.plane_error = 2.0f * area_error * scale + 16.0f * unit_roundoff;
  t.vertex_norm1 = max_norm1(a, b, c);
  return t;
}

// Comparisons are written so that a NaN (needles, overflow) ends as `pair_unsure`.
SHARED int classify(IN(CameraFrame) camera, IN(TrianglePlanes) t, IN(vec3) p, float eye_distance) {
  vec3 q = p - t.corner;
  float distance = norm1(q);
  float e0 = dot(t.edge0, q);
  float e1 = dot(t.edge1, q) - t.offset1;
  float e2 = dot(t.edge2, q);
  float b0 = t.edge_error.x * distance;
  float b1 = t.edge_error.y * (distance + t.extent);
  float b2 = t.edge_error.z * distance;
  bool above0 = e0 > b0;
  bool above1 = e1 > b1;
  bool above2 = e2 > b2;
  bool below0 = e0 < -b0;
  bool below1 = e1 < -b1;
  bool below2 = e2 < -b2;
  // Inside means one sign on all three edges; two certain and different signs are outside whatever the winding.
  bool outside = (above0 || above1 || above2) && (below0 || below1 || below2);
  bool inside = (above0 && above1 && above2) || (below0 && below1 && below2);

  float height = -dot(t.plane, q);
  float height_error = t.plane_error * distance;
  float bias = plane_bias(camera, p, eye_distance, t.vertex_norm1);
  bool behind = t.sided && height + height_error < bias;
  bool before = t.sided && height - height_error > bias;
  if (outside || behind) return pair_out;
  return inside && before ? pair_in : pair_unsure;
}

SHARED_END
#endif
