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
  vec2 width;      // of the footprint facing the viewer
  vec2 tilt;       // slopes of the G-buffer: n.along = n.width - tilt n.turn, with turn = center or, orthographic, z
  float extent;    // bounds |along_x|_1 + |along_y|_1 and, times 4u, their errors
  float t;         // eye distance of the center
  vec2 doubt;      // doubt_of
};

// In the G-buffer: x: eye distance; yz: slopes of 1/t as a share of 1/t (perspective) or of t (orthographic), a pixel,
// already shrunk; w: the footprint's scale in (0, 1], 1 unless it was shrunk; the last five bits of its mantissa hold the
// overhang as a power of two.
// A footprint that reaches the horizon or nearly does is shrunk toward its centre, until every corner's t lies within
// [1/2, 2] of the centre's. In double: near the horizon the slopes magnify each error.
SHARED float scale_of(IN(vec4) data) { return uintBitsToFloat(floatBitsToUint(data.w) & ~31u); }

const int least_overhang = -4;  // as a power of two

// Half the micro-quad's size over its own triangle's height, rounded up to a power of two: so far outside its triangle a plane
// is uncertain.
SHARED float overhang_of(IN(vec4) data) {
  return uintBitsToFloat((uint(127 + least_overhang) + (floatBitsToUint(data.w) & 31u)) << 23);
}

// How far a point of the micro-quad may lie off its triangle's plane, in roundings of |P|_1. x: 2 for the centre, 4 times the
// steepness for the slopes and for a t of up to twice the centre's. y: also the vertices' own rounding, which grows outside.
SHARED vec2 doubt_of(IN(CameraFrame) camera, IN(vec4) data) {
  PRECISE float change = abs(data.y) + abs(data.z);
  PRECISE float steepness = is_perspective(camera) ? change : change / data.x;
  PRECISE float point = 2.0f + 4.0f * steepness;
  PRECISE float plane = point + (1.0f + 2.0f * overhang_of(data));
  return vec2(point, plane);
}

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
  if (!(scale > 0.0)) return vec4(t, 0.0f, 0.0f, 1.0f);  // edge-on: the centre alone
  // Half the footprint's size on the plane over the triangle's smallest height, as a power of two.
  double size = perspective ? double(t) : 1.0;
  double half_x = 0.5 * scale * sqrt(ax * ax * size * size + sx * sx * size * size);
  double half_y = 0.5 * scale * sqrt(ay * ay * size * size + sy * sy * size * size);
  double longest2 = max(dot(e1, e1), max(dot(e2, e2), dot(e3, e3)));
  double overhang = (half_x + half_y) * sqrt(longest2 / dot(n, n));
  // The exponent, rounded up; infinity where there is no triangle to speak of.
  int power = int((floatBitsToUint(float(overhang)) + 0x7fffffu) >> 23) - 127 - least_overhang;
  uint bits = uint(clamp(power, 0, 31));
  float word = uintBitsToFloat((floatBitsToUint(float(scale)) & ~31u) | bits);
  double kept = double(scale_of(vec4(0.0f, 0.0f, 0.0f, word)));
  return vec4(t, float(sx * kept), float(sy * kept), word);
}

SHARED MicroQuad make_micro_quad(IN(CameraFrame) camera, IN(ivec2) px, IN(vec4) data) {
  MicroQuad m;
  float k = scale_of(data);
  m.t = data.x;
  m.doubt = doubt_of(camera, data);
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
  m.width = vec2(wx, wy);
  m.tilt = vec2(data.y, data.z);
  m.extent = (wx + wy) + norm1(turn) * (abs(data.y) + abs(data.z));
  return m;
}

SHARED vec3 micro_quad_point(IN(MicroQuad) m, IN(vec2) o) {
  float scale = 1.0f / (1.0f + (o.x * m.slope.x + o.y * m.slope.y));
  return m.center + (m.along_x * o.x + m.along_y * o.y) * scale;
}

SHARED_END
#endif
