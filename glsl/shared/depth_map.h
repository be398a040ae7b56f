// SPDX-License-Identifier: MIT
// A depth map of the light (Williams 1978) and what of it a receiver is compared with: where it falls, how its plane runs
// there, and by how much it is moved towards the light so that it does not shadow itself.
#ifndef IZB_SHARED_DEPTH_MAP_H
#define IZB_SHARED_DEPTH_MAP_H
#include "shared/bounds.h"
SHARED_BEGIN

// The options of the comparison, lengths in texels of the map.
struct MapBias {
  float constant;       // along the light's ray
  float slope;          // texels over which the receiver's plane may rise
  float normal_offset;  // along the receiver's normal, times the sine of its angle to the light
  float plane;          // 1: each texel is compared with the receiver's plane at its centre, 0: with the receiver
};

// A wall along the light's ray has no finite slope. A bias is paid for by leaks: it ends earlier than the plane.
const float steepest_plane = 256.0f;
const float steepest_bias = 16.0f;

// The window with so many texels more around the receivers, so that a filter finds casters beyond their border.
SHARED LightWindow with_margin(IN(LightWindow) w, float texels) {
  LightWindow wide = w;
  float side = w.guard.y;
  if (side == 0.0f) return wide;
  float shrink = (side - 2.0f - 2.0f * texels) / (side - 2.0f);
  vec2 half_size = vec2(0.5f * side / w.window.z, 0.5f * side / w.window.w);
  vec2 center = vec2(w.window.x, w.window.y) + half_size;
  vec2 low = center - half_size / shrink;
  wide.window = vec4(low.x, low.y, w.window.z * shrink, w.window.w * shrink);
  return wide;
}

// Clip space of a map of `side` texels: grid_position before its division, so that hardware interpolates as it must.
SHARED vec4 map_clip(IN(LightFrame) light, IN(LightWindow) w, float side, IN(vec3) p_vs) {
  vec3 p = light_position(light, p_vs);
  bool positional = is_positional(light);
  float h = positional ? p.z : 1.0f;
  float x = (p.x - w.window.x * h) * (w.window.z * (2.0f / side)) - h;
  float y = (p.y - w.window.y * h) * (w.window.w * (2.0f / side)) - h;
  float z = positional ? w.depth.x * h - w.depth.y : w.depth.x + w.depth.y * p.z;
  return vec4(x, y, z, h);
}

struct MapReceiver {
  vec2 at;      // texels
  float depth;  // of the map, bias not subtracted
  vec2 slope;   // of its plane: change of depth a texel
  float bias;   // depth
};

// How far a receiver's plane sinks away from the light over a length across its ray, along the map's x and y.
SHARED vec2 plane_slope(IN(LightFrame) light, IN(vec3) p_ls, IN(vec3) normal_ls, float steepest) {
  float along = is_positional(light) ? dot(normal_ls, p_ls) / p_ls.z : normal_ls.z;
  float least = max(abs(normal_ls.x), abs(normal_ls.y)) / steepest + 1.0e-20f;
  float limited = along < 0.0f ? min(along, -least) : max(along, least);
  return vec2(-normal_ls.x / limited, -normal_ls.y / limited);
}

// `light` is the face's; normal_vs has unit length.
SHARED MapReceiver make_map_receiver(IN(LightFrame) light, IN(LightWindow) w, IN(MapBias) bias, IN(vec3) p_vs,
                                     IN(vec3) normal_vs) {
  vec3 n = vec3(dot(vec3(light.axis_x), normal_vs), dot(vec3(light.axis_y), normal_vs), dot(vec3(light.axis_z), normal_vs));
  vec3 p = light_position(light, p_vs);
  bool positional = is_positional(light);
  vec2 texel = vec2(1.0f / w.window.z, 1.0f / w.window.w) * (positional ? p.z : 1.0f);  // world units
  float largest = max(texel.x, texel.y);
  float cosine = positional ? -dot(n, p) / max(length(p), 1.0e-20f) : -n.z;
  float sine = sqrt(max(1.0f - cosine * cosine, 0.0f));
  p += n * ((cosine < 0.0f ? -1.0f : 1.0f) * bias.normal_offset * largest * sine);
  vec3 grid = grid_position(w, light_uvd(light, p));
  float depth_a_unit = positional ? w.depth.y / (p.z * p.z) : w.depth.y;
  MapReceiver r;
  r.at = vec2(grid.x, grid.y);
  r.depth = grid.z;
  r.slope = plane_slope(light, p, n, steepest_plane) * texel * depth_a_unit;
  vec2 rise = abs(plane_slope(light, p, n, steepest_bias) * texel * depth_a_unit);  // over a texel along each axis
  // The map's depth and the receiver's are rounded in different ways.
  float rounding = 4.0f * (d_error(light, p_vs, p) * w.depth.y + 8.0f * unit_roundoff * (1.0f + abs(w.depth.x)));
  r.bias = bias.constant * largest * depth_a_unit + bias.slope * (rise.x + rise.y) + rounding;
  return r;
}

// Depths of the map below it shadow the receiver, at texel position `at`. Nothing is beyond 1, the depth of no caster.
SHARED float map_reference(IN(MapReceiver) r, IN(MapBias) bias, IN(vec2) at) {
  return min(r.depth + bias.plane * dot(r.slope, at - r.at), 1.0f) - r.bias;
}

SHARED bool is_on_map(IN(MapReceiver) r, float side) {
  return r.at.x >= 0.0f && r.at.y >= 0.0f && r.at.x <= side && r.at.y <= side;
}

struct MapCounters {
  uint receivers;    // samples that were looked up
  uint comparisons;  // of texels of the map; four each where hardware filters
  uint outside;      // samples that the map does not reach
  uint unused;
};

SHARED_END
#endif
