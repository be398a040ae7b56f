// SPDX-License-Identifier: MIT
// The micro-quad (4, 5.1): a pixel's footprint on the tangent plane of what it sees. Along the ray of a sub-pixel position,
// 1/t (perspective) or t (orthographic) is affine in pixel coordinates, so that the receiver point and three floats hold it.
#ifndef IZB_SHARED_MICRO_QUAD_H
#define IZB_SHARED_MICRO_QUAD_H
#include "shared/light.h"
SHARED_BEGIN

struct SampleFrame {
  vec4 offset_px[32];  // xy: from the pixel's centre
  uvec4 info;          // x: number of samples, y: side of the look-up table
};

// The sample at offset o lies at center + (o.x along_x + o.y along_y) / (1 + dot(o, slope)).
struct MicroQuad {
  vec3 center;
  vec3 along_x;
  vec3 along_y;
  vec2 slope;      // perspective: change of 1/t a pixel, as a share of 1/t; orthographic: 0
  float extent;    // bounds |along_x|_1 + |along_y|_1 and, times 4u, their errors
  float t;         // eye distance of the center
  bool overhangs;  // wider than its own triangle, whose plane is uncertain that far outside
};

// In the G-buffer: x: eye distance; yz: slopes of 1/t as a share of 1/t (perspective) or of t (orthographic), a pixel,
// already shrunk; |w|: the footprint's scale, 1 unless it was shrunk; w < 0: the micro-quad overhangs its triangle.
// A footprint that reaches the horizon or nearly does is shrunk toward its centre, until every corner's t lies within
// [1/2, 2] of the centre's. In double: near the horizon the slopes magnify each error.
SHARED vec4 micro_quad_data(IN(CameraFrame) camera, IN(vec2) px, float t, IN(vec3) a, IN(vec3) b, IN(vec3) c) {
  dvec3 e1 = dvec3(b) - dvec3(a);
  dvec3 e2 = dvec3(c) - dvec3(a);
  dvec3 e3 = dvec3(c) - dvec3(b);
  dvec3 n = cross(e1, e2);
  bool perspective = is_perspective(camera);
  double ax = double(camera.pixel_ray.x);
  double ay = double(camera.pixel_ray.y);
  float qx = px.x * camera.pixel_ray.x + camera.pixel_ray.z;
  float qy = px.y * camera.pixel_ray.y + camera.pixel_ray.w;
  double facing = perspective ? (n.x * double(qx) + n.y * double(qy)) - n.z : n.z;
  double sx = n.x * ax / facing;
  double sy = n.y * ay / facing;
  double steepness = abs(sx) + abs(sy);
  double limit = perspective ? 1.0 : double(t);
  double scale = steepness <= limit ? 1.0 : limit / steepness;
  if (!(scale > 0.0)) return vec4(t, 0.0f, 0.0f, 1.0e-30f);  // edge-on: the centre alone
  // Half the footprint's size on the plane against the triangle's smallest height.
  double width = perspective ? double(t) : 1.0;
  double rise = perspective ? double(t) : 1.0;
  double half_x = 0.5 * scale * sqrt(ax * ax * width * width + sx * sx * rise * rise);
  double half_y = 0.5 * scale * sqrt(ay * ay * width * width + sy * sy * rise * rise);
  double longest2 = max(dot(e1, e1), max(dot(e2, e2), dot(e3, e3)));
  bool overhangs = (half_x + half_y) * sqrt(longest2) > sqrt(dot(n, n));
  return vec4(t, float(sx * scale), float(sy * scale), overhangs ? -float(scale) : float(scale));
}

SHARED MicroQuad make_micro_quad(IN(CameraFrame) camera, IN(ivec2) px, IN(vec4) data) {
  MicroQuad m;
  float k = abs(data.w);
  m.t = data.x;
  m.overhangs = data.w < 0.0f;
  m.center = receiver_point(camera, vec2(float(px.x) + 0.5f, float(px.y) + 0.5f), data.x);
  bool perspective = is_perspective(camera);
  float width = perspective ? k * data.x : k;
  float wx = camera.pixel_ray.x * width;
  float wy = camera.pixel_ray.y * width;
  vec3 turn = perspective ? m.center : vec3(0.0f, 0.0f, 1.0f);
  PRECISE vec3 along_x = vec3(wx - turn.x * data.y, -(turn.y * data.y), -(turn.z * data.y));
  PRECISE vec3 along_y = vec3(-(turn.x * data.z), wy - turn.y * data.z, -(turn.z * data.z));
  m.along_x = along_x;
  m.along_y = along_y;
  m.slope = perspective ? vec2(data.y, data.z) : vec2(0.0f);
  m.extent = (wx + wy) + norm1(turn) * (abs(data.y) + abs(data.z));
  return m;
}

SHARED vec3 micro_quad_point(IN(MicroQuad) m, IN(vec2) o) {
  float scale = 1.0f / (1.0f + (o.x * m.slope.x + o.y * m.slope.y));
  return m.center + (m.along_x * o.x + m.along_y * o.y) * scale;
}

SHARED_END
#endif
