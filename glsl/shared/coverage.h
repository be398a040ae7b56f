// SPDX-License-Identifier: MIT
// Which of a pixel's 32 samples does a triangle hide from the light? The paper's frustum-triangle test (4): three shadow
// quads and the triangle's own plane cut the tangent plane along lines, each a half-plane over the pixel.
//
// The plane f(X) = n.(c - X), times 1 + o.slope > 0, is affine in the sample's offset o (facts of projective geometry: both
// are affine along the pixel's rays): f0 + o.x fx + o.y fy with f0 = f(center), f' = f0 slope - n.along.
//
// `occluded_sample` in double is the definition. `classify_quad` gives the same bits in single precision where its error
// bounds allow and says which samples it is unsure of.
#ifndef IZB_SHARED_COVERAGE_H
#define IZB_SHARED_COVERAGE_H
#include "shared/micro_quad.h"
#include "shared/occlusion.h"
SHARED_BEGIN

// As plane_bias, for the points of a micro-quad: see docs/VALIDATION.md. x: what the height must exceed anyway; y: and where
// the two planes may be one that rounding bent.
SHARED vec2 quad_bias(IN(CameraFrame) camera, IN(vec3) p, float t, float vertex_norm1, IN(vec2) doubt) {
  PRECISE float rounding = unit_roundoff * (doubt.y * norm1(p) + 1.25f * vertex_norm1);
  PRECISE float limit = pixel_width(camera, t) * 0.0078125f;
  PRECISE float own = 6.0f * unit_roundoff * norm1(p);
  PRECISE float point = unit_roundoff * doubt.x * norm1(p);
  return vec2(point, min(rounding, max(limit, own)));
}

// ---- the definition, in double ----------------------------------------------------------------------------------

struct QuadPlanes {
  dvec3 edge0;  // f0, fx, fy of each edge's plane, inside >= 0
  dvec3 edge1;
  dvec3 edge2;
  dvec3 height;  // of the triangle's plane over the receiver, times |n|
  dvec3 bias;    // what the height must exceed: likewise, times |n|^2 when squared
  double length2;
  bool casts;
};

SHARED dvec3 quad_plane(IN(dvec3) n, IN(dvec3) q, IN(dvec3) along_x, IN(dvec3) along_y, IN(dvec3) slope) {
  PRECISE double f0 = (n.x * q.x + n.y * q.y) + n.z * q.z;
  PRECISE double nx = (n.x * along_x.x + n.y * along_x.y) + n.z * along_x.z;
  PRECISE double ny = (n.x * along_y.x + n.y * along_y.y) + n.z * along_y.z;
  PRECISE double fx = f0 * slope.x - nx;
  PRECISE double fy = f0 * slope.y - ny;
  return dvec3(f0, fx, fy);
}

SHARED dvec3 cross_exactly(IN(dvec3) a, IN(dvec3) b) {
  PRECISE double x = a.y * b.z - a.z * b.y;
  PRECISE double y = a.z * b.x - a.x * b.z;
  PRECISE double z = a.x * b.y - a.y * b.x;
  return dvec3(x, y, z);
}

// Vertices in the order of their positions, so that the two triangles of a shared edge get the same numbers with opposite
// signs.
SHARED dvec3 quad_edge(IN(LightFrame) light, IN(vec3) a, IN(vec3) b, IN(vec3) p, IN(dvec3) along_x, IN(dvec3) along_y,
                       IN(dvec3) slope, double sign) {
  bool swapped = position_less(b, a);
  vec3 first = swapped ? b : a;
  vec3 second = swapped ? a : b;
  dvec3 w = is_positional(light) ? dvec3(vec3(light.origin)) - dvec3(first) : dvec3(vec3(light.to_light));
  dvec3 n = cross_exactly(dvec3(second) - dvec3(first), w);
  dvec3 plane = quad_plane(n, dvec3(first) - dvec3(p), along_x, along_y, slope);
  return swapped == (sign > 0.0) ? -plane : plane;
}

SHARED double longest2(IN(vec3) a, IN(vec3) b, IN(vec3) c) {
  dvec3 ab = dvec3(b) - dvec3(a);
  dvec3 bc = dvec3(c) - dvec3(b);
  dvec3 ca = dvec3(a) - dvec3(c);
  return max(dot(ab, ab), max(dot(bc, bc), dot(ca, ca)));
}

SHARED QuadPlanes quad_planes(IN(CameraFrame) camera, IN(LightFrame) light, IN(vec3) a, IN(vec3) b, IN(vec3) c,
                              IN(ivec2) px, IN(vec4) data) {
  vec3 p = receiver_point(camera, vec2(float(px.x) + 0.5f, float(px.y) + 0.5f), data.x);
  bool perspective = is_perspective(camera);
  double k = double(scale_of(data));
  double width = perspective ? k * double(data.x) : k;
  dvec3 turn = perspective ? dvec3(p) : dvec3(0.0, 0.0, 1.0);
  double sx = double(data.y);
  double sy = double(data.z);
  PRECISE double wx = double(camera.pixel_ray.x) * width - turn.x * sx;
  PRECISE double wy = double(camera.pixel_ray.y) * width - turn.y * sy;
  dvec3 along_x = dvec3(wx, -(turn.y * sx), -(turn.z * sx));
  dvec3 along_y = dvec3(-(turn.x * sy), wy, -(turn.z * sy));
  dvec3 slope = perspective ? dvec3(sx, sy, 0.0) : dvec3(0.0);

  QuadPlanes planes;
  dvec3 n = cross_exactly(dvec3(b) - dvec3(a), dvec3(c) - dvec3(a));
  dvec3 w = is_positional(light) ? dvec3(vec3(light.origin)) - dvec3(a) : dvec3(vec3(light.to_light));
  PRECISE double side = (n.x * w.x + n.y * w.y) + n.z * w.z;
  double sign = side > 0.0 ? 1.0 : -1.0;
  planes.casts = side != 0.0 && !holds_light(light, a, b, c);
  planes.edge0 = quad_edge(light, a, b, p, along_x, along_y, slope, sign);
  planes.edge1 = quad_edge(light, b, c, p, along_x, along_y, slope, sign);
  planes.edge2 = quad_edge(light, c, a, p, along_x, along_y, slope, sign);
  planes.height = quad_plane(n * sign, dvec3(a) - dvec3(p), along_x, along_y, slope);
  PRECISE double length2 = (n.x * n.x + n.y * n.y) + n.z * n.z;
  planes.length2 = length2;
  // One plane, bent by rounding, rises by twice its rounding over the micro-quad; what rises more is two. A bias would only
  // move the line where they meet, and open a crack beside an occluder that is thinner, as one is that the light grazes.
  float vertex_norm1 = max_norm1(a, b, c);
  vec2 doubt = doubt_of(camera, data);
  PRECISE double extent = double(camera.pixel_ray.x + camera.pixel_ray.y) * width +
                          double(norm1(perspective ? p : vec3(0.0f, 0.0f, 1.0f))) * (abs(sx) + abs(sy));
  PRECISE double overhang = extent * sqrt(longest2(a, b, c) / length2);
  PRECISE double rounding = double(unit_roundoff) * (double(doubt.y) * double(norm1(p)) +
                                                     1.25 * double(vertex_norm1) * (1.0 + overhang));
  PRECISE double rise = abs(planes.height.y) + abs(planes.height.z);
  bool parallel = !(rise > 2.0 * rounding * sqrt(length2));
  vec2 biases = quad_bias(camera, p, data.x, vertex_norm1, doubt);
  planes.bias = dvec3(1.0, slope.x, slope.y) * double(parallel ? biases.y : biases.x);
  return planes;
}

SHARED double plane_at(IN(dvec3) plane, IN(vec2) o) {
  PRECISE double value = (plane.x + double(o.x) * plane.y) + double(o.y) * plane.z;
  return value;
}

SHARED bool occluded_sample(IN(QuadPlanes) t, IN(vec2) o) {
  double height = plane_at(t.height, o);
  double bias = plane_at(t.bias, o);
  PRECISE double height2 = height * height;
  PRECISE double bias2 = bias * bias * t.length2;
  return t.casts && height > 0.0 && height2 > bias2 && plane_at(t.edge0, o) >= 0.0 && plane_at(t.edge1, o) >= 0.0 &&
         plane_at(t.edge2, o) >= 0.0;
}

// ---- the same in single precision ---------------------------------------------------------------------------------
//
// fx = f0 slope - n.along, and with f0 = n.first - n.center the terms in n.center cancel: fx = tilt n.first - n.x width, where an
// orthographic camera has n.z in place of n.first. So a line takes one product with the receiver and three floats of it.

SHARED void order_two(OUT(vec3) first, OUT(vec3) second) {
  bool swapped = position_less(second, first);
  vec3 kept = first;
  first = swapped ? second : first;
  second = swapped ? kept : second;
}

// By position: two triangles that share an edge then give the same numbers for it.
SHARED void order_vertices(OUT(vec3) a, OUT(vec3) b, OUT(vec3) c) {
  order_two(a, b);
  order_two(b, c);
  order_two(a, b);
}

// An edge's plane, by vertices in the order of their positions: what both triangles of a shared edge compute alike.
struct EdgePlane {
  vec3 first;
  vec3 normal;
  float turned;  // turned_by
  float error;   // edge_error_of
};

// Of a triangle whose vertices stand in the order of their positions: the edges ab, bc, ac.
struct QuadTriangle {
  EdgePlane edge0;
  EdgePlane edge1;
  EdgePlane edge2;
  vec3 plane;  // unit, towards the light
  float plane_turned;
  float plane_error;
  float per_height;  // 1 over its smallest height
  float vertex_norm1;
  bool sided;          // the plane's side to the light is certain
  bool facing;         // that side, by the triangle's own order
};

SHARED float turned_by(IN(CameraFrame) camera, IN(vec3) n, IN(vec3) first) {
  PRECISE float along = (n.x * first.x + n.y * first.y) + n.z * first.z;
  return is_perspective(camera) ? along : n.z;
}

SHARED EdgePlane make_edge_plane(IN(CameraFrame) camera, IN(LightFrame) light, IN(vec3) first, IN(vec3) second) {
  EdgePlane e;
  e.first = first;
  vec3 edge = second - first;
  vec3 w = is_positional(light) ? vec3(light.origin) - first : vec3(light.to_light);
  PRECISE float x = edge.y * w.z - edge.z * w.y;
  PRECISE float y = edge.z * w.x - edge.x * w.z;
  PRECISE float z = edge.x * w.y - edge.y * w.x;
  e.normal = vec3(x, y, z);
  e.turned = turned_by(camera, e.normal, first);
  e.error = edge_error_of(edge, w);
  return e;
}

SHARED QuadTriangle make_quad_triangle(IN(CameraFrame) camera, IN(LightFrame) light, IN(vec3) a, IN(vec3) b, IN(vec3) c) {
  QuadTriangle t;
  t.edge0 = make_edge_plane(camera, light, a, b);
  t.edge1 = make_edge_plane(camera, light, b, c);
  t.edge2 = make_edge_plane(camera, light, a, c);
  vec3 w = is_positional(light) ? vec3(light.origin) - a : vec3(light.to_light);
  vec3 n = cross(b - a, c - a);
  float area_error = edge_error_of(b - a, c - a);
  float side = dot(n, w);
  float length2 = dot(n, n);
  float scale = 1.0f / sqrt(length2);
  t.sided = abs(side) > 2.0f * area_error * norm1(w) && length2 > 1.0e-30f && length2 < 1.0e37f;
  t.facing = side > 0.0f;
  t.plane = n * (side < 0.0f ? -scale : scale);
  t.plane_turned = turned_by(camera, t.plane, a);
  t.per_height = sqrt(max(dot(b - a, b - a), max(dot(c - b, c - b), dot(c - a, c - a)))) * scale;
  t.plane_error = 2.0f * area_error * scale + 16.0f * unit_roundoff;
  t.vertex_norm1 = max_norm1(a, b, c);
  return t;
}

// f0, fx, fy of a plane over the micro-quad; q: from its center to a point of the plane.
SHARED vec3 quad_line(IN(vec3) n, float turned, IN(vec3) q, IN(MicroQuad) m) {
  PRECISE float f0 = (n.x * q.x + n.y * q.y) + n.z * q.z;
  PRECISE float fx = m.tilt.x * turned - n.x * m.width.x;
  PRECISE float fy = m.tilt.y * turned - n.y * m.width.y;
  return vec3(f0, fx, fy);
}

// Bounds the error of a quad_line over the pixel: see docs/VALIDATION.md.
SHARED float quad_line_error(float plane_error, float vertex_norm1, IN(vec3) q, IN(MicroQuad) m) {
  return plane_error *
         (norm1(q) + 0.75f * ((abs(m.tilt.x) + abs(m.tilt.y)) * vertex_norm1 + (m.width.x + m.width.y)));
}

// xyz: a triangle's height over the micro-quad, less the bias; w: bounds its error, boundless where the bias is unsure.
SHARED vec4 quad_height(IN(CameraFrame) camera, IN(QuadTriangle) t, IN(vec3) q, IN(MicroQuad) m) {
  vec3 height = quad_line(t.plane, t.plane_turned, q, m);
  float error = quad_line_error(t.plane_error, t.vertex_norm1, q, m);
  vec2 bias = quad_bias(camera, m.center, m.t, t.vertex_norm1, m.doubt);
  float rounding = unit_roundoff * (m.doubt.y * norm1(m.center) + 1.25f * t.vertex_norm1 * (1.0f + m.extent * t.per_height));
  float rise = abs(height.y) + abs(height.z);
  if (!(abs(rise - 2.0f * rounding) > 2.0f * error + rounding * 0.0001f)) error = 3.0e38f;
  height -= (rise > 2.0f * rounding ? bias.x : bias.y) * vec3(1.0f, m.slope.x, m.slope.y);
  return vec4(height, error);
}

SHARED_END
#endif
