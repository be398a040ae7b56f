// SPDX-License-Identifier: MIT
// From the receivers' extremes in light space to the window of the light-space grid (5.2).
#ifndef IZB_SHARED_BOUNDS_H
#define IZB_SHARED_BOUNDS_H
#include "shared/light.h"
SHARED_BEGIN

// Floats as unsigned integers of the same order, since atomics know only integers.
struct ReceiverBounds {
  uvec4 low;    // u, v, d; cleared to ~0
  uvec4 high;   // u, v, d; cleared to 0
  uvec4 slack;  // largest uv_error, largest d_error, number of receivers; cleared to 0
};

// The visible depth range and where it is cut (5.2).
struct CascadeRange {
  uvec4 reached;  // x: bits of the nearest receiver's eye distance, cleared to ~0; y: of the furthest, cleared to 0
  vec4 ends[2];   // eye distance at which each cascade but the last ends
};

// Logarithmic split (Lauritzen et al. 2011): equal ratios.
SHARED void split_cascades(OUT(CascadeRange) range, int cascades) {
  float nearest = uintBitsToFloat(range.reached.x);
  float furthest = uintBitsToFloat(range.reached.y);
  for (int i = 0; i < max_cascades; ++i) {
    float end = 3.0e38f;
    if (i < cascades - 1 && range.reached.y != 0u)
      end = nearest * pow(furthest / nearest, float(i + 1) / float(cascades));
    range.ends[i / 4][i % 4] = end;
  }
}

// The cascade of a pixel is that of its centre, micro-quad and all; each window holds all corners of its micro-quads, so
// that nothing leaks at a border.
SHARED int cascade_of(IN(CascadeRange) range, int cascades, float t) {
  int cascade = 0;
  for (int i = 0; i < cascades - 1; ++i)
    if (t > range.ends[i / 4][i % 4]) cascade = i + 1;
  return cascade;
}

SHARED uint ordered_from_float(float f) {
  uint bits = floatBitsToUint(f);
  return (bits & 0x80000000u) != 0u ? ~bits : bits | 0x80000000u;
}

SHARED float float_from_ordered(uint ordered) {
  return uintBitsToFloat((ordered & 0x80000000u) != 0u ? ordered & 0x7fffffffu : ~ordered);
}

// How fine a grid is for so many receivers. More texels would only be visited by more triangles: a window that holds few is
// small, and so are its texels.
SHARED float side_in_use(IN(LightFrame) light, uint receivers) {
  float side = float(light.grid.x);
  float density = light.axis_y.w;
  return density > 0.0f ? min(side, max(16.0f, ceil(sqrt(density * float(receivers))))) : side;
}

// Texels by which a grid position may be wrong whose u and v are off by uv_error, and the same for a depth.
SHARED float texel_guard(IN(LightWindow) w, float uv_error) {
  return uv_error * max(w.window.z, w.window.w) + 8.0f * unit_roundoff * w.guard.y;
}

SHARED float depth_guard(IN(LightWindow) w, float d_error) {
  return d_error * w.depth.y + 8.0f * unit_roundoff * (1.0f + abs(w.depth.x));
}

// The receivers fill all but one texel at each border; a window without extent gets one from the values' own rounding.
SHARED LightWindow make_window(IN(LightFrame) light, IN(ReceiverBounds) b) {
  LightWindow w;
  w.window = vec4(0.0f, 0.0f, 1.0f, 1.0f);
  w.depth = vec4(0.0f);
  w.guard = vec4(0.0f);
  if (b.slack.z == 0u) return w;
  vec3 low = vec3(float_from_ordered(b.low.x), float_from_ordered(b.low.y), float_from_ordered(b.low.z));
  vec3 high = vec3(float_from_ordered(b.high.x), float_from_ordered(b.high.y), float_from_ordered(b.high.z));
  float uv_slack = float_from_ordered(b.slack.x);
  float d_slack = float_from_ordered(b.slack.y);
  float side = side_in_use(light, b.slack.z);
  vec3 tiny = 0.000001f * max(abs(low), abs(high)) + vec3(1.0e-30f);
  vec3 extent = max(high - low, tiny);
  vec2 scale = vec2((side - 2.0f) / extent.x, (side - 2.0f) / extent.y);
  w.window = vec4(low.x - 1.0f / scale.x, low.y - 1.0f / scale.y, scale.x, scale.y);
  float depth_scale = 0.5f / extent.z;
  float depth_offset = 0.25f - low.z * depth_scale;
  w.depth = vec4(depth_offset, depth_scale, 0.0f, 0.0f);
  w.guard = vec4(0.0f, side, 0.0f, 0.0f);
  w.guard.x = texel_guard(w, uv_slack);
  w.depth.z = depth_guard(w, d_slack);
  return w;
}

// Of micro-quads. A pixel whose own is more wrong than this window's guards say brings its own guard along (faces.h,
// quad_guard). One that nearly reaches the light's plane is wrong by several texels; with a guard for that one a hundred
// thousand other pixels went into more than a hundred texels each.
SHARED LightWindow make_quad_window(IN(LightFrame) light, IN(ReceiverBounds) b) {
  LightWindow w = make_window(light, b);
  w.guard.x = min(w.guard.x, 0.0625f);
  w.depth.z = min(w.depth.z, 0.00048828125f);
  return w;
}

// The last texel of a row or a column.
SHARED int last_texel(IN(LightWindow) window) { return int(window.guard.y) - 1; }

// The texel of a grid position.
SHARED ivec2 grid_texel(IN(LightWindow) window, IN(vec3) grid) {
  int last = last_texel(window);
  return ivec2(clamp(int(floor(grid.x)), 0, last), clamp(int(floor(grid.y)), 0, last));
}

SHARED_END
#endif
