// SPDX-License-Identifier: MIT
// The eye-space G-buffer of 5.1: which triangle a pixel sees, and where its receiver point lies.
#ifndef IZB_SHARED_GBUFFER_H
#define IZB_SHARED_GBUFFER_H
#include "shared/camera.h"
SHARED_BEGIN

struct MaterialFrame {
  vec4 base_color;  // linear
  vec4 uv_u;        // texture coordinate u = dot(xyz, (u, v, 1)); w: cut-off of alpha, in 255ths
  vec4 uv_v;
  uvec4 alpha;      // x: first texel of its alpha map, y: width and, from bit 16 on, height, z: bits, see alpha.h
};

struct ReceiverPlane {
  float eye_distance;  // t of receiver_point
  vec3 normal_vs;      // unit, geometric, on the viewer's side
  bool on_plane;       // false: seen edge-on, up to rounding; the point is near the triangle, but not on its plane
};

// Where the ray of pixel position px meets the plane of triangle abc, in double, rounded once: interpolated depth would
// be off by many ulp. The point's distance from the plane is at most 2u |P|_1: u from the rounding of t, u from that of the
// products in receiver_point. A sliver that only the rasteriser's rounding makes visible may meet its plane anywhere: it is
// kept within one of its own lengths of its vertices, and gets no light.
SHARED ReceiverPlane intersect_plane(IN(CameraFrame) camera, IN(vec2) px, IN(vec3) a, IN(vec3) b, IN(vec3) c) {
  dvec3 e1 = dvec3(b) - dvec3(a);
  dvec3 e2 = dvec3(c) - dvec3(a);
  PRECISE double nx = e1.y * e2.z - e1.z * e2.y;
  PRECISE double ny = e1.z * e2.x - e1.x * e2.z;
  PRECISE double nz = e1.x * e2.y - e1.y * e2.x;
  // The same floats as in receiver_point.
  PRECISE float qx = px.x * camera.pixel_ray.x + camera.pixel_ray.z;
  PRECISE float qy = px.y * camera.pixel_ray.y + camera.pixel_ray.w;
  bool perspective = is_perspective(camera);
  dvec3 origin = perspective ? dvec3(0.0) : dvec3(double(qx), double(qy), 0.0);
  dvec3 ray = perspective ? dvec3(double(qx), double(qy), -1.0) : dvec3(0.0, 0.0, -1.0);
  dvec3 to_plane = dvec3(a) - origin;
  PRECISE double distance = (nx * to_plane.x + ny * to_plane.y) + nz * to_plane.z;
  PRECISE double slope = (nx * ray.x + ny * ray.y) + nz * ray.z;
  PRECISE double t = distance / slope;
  double t_min = -double(max(a.z, max(b.z, c.z)));
  double t_max = -double(min(a.z, min(b.z, c.z)));
  // 2^-40 of the distance more, since one that faces the camera has none, and t is rounded.
  double length = (t_max - t_min) + 9.0949470177292824e-13 * max(abs(t_min), abs(t_max));
  double crossing = t;
  if (!(t > t_min - length)) t = t_min - length;  // also NaN
  if (t > t_max + length) t = t_max + length;
  double nearest = t_min > 0.0 ? t_min * 0.5 : t_max * 1.0e-6;
  if (t < nearest) t = nearest;

  PRECISE double inverse = 1.0 / sqrt((nx * nx + ny * ny) + nz * nz);
  double sign = slope > 0.0 ? -inverse : inverse;
  ReceiverPlane r;
  r.on_plane = t == crossing;
  r.eye_distance = float(t);
  r.normal_vs = vec3(float(nx * sign), float(ny * sign), float(nz * sign));
  return r;
}

SHARED_END
#endif
