#version 450 core
// 5.5 by compute: the tiles of a large triangle that it may shadow something in, each to be swept by an invocation of its own. Here
// an invocation has a row of them. Defines, beside those of 5_visibility_list.comp.glsl: COUNT: count the triangles.
#include "shared/bindings.h"
#include "shared/geometry.glsl"
#include "shared/coverage.h"
#include "shared/pairs.h"
#include "shared/sweep.h"

layout(local_size_x = 64) in;

layout(location = 1) uniform float dilation;  // texels

layout(std140, binding = BIND_LIGHT) uniform LightBlock { LightFrame light; };
layout(std140, binding = BIND_WINDOWS) uniform WindowBlock { LightWindow windows[max_layers]; };
layout(std430, binding = BIND_LISTED) buffer ListedBlock { ListedTriangle listed[]; };
layout(std430, binding = BIND_LISTED_COUNTS) buffer ListedCountBlock { ListedCounts counts; };
layout(std430, binding = BIND_COUNTERS) buffer CounterBlock { Counters counters; };
#ifdef PYRAMID
#include "shadow/izb/behind_all.glsl"
#endif
#include "shadow/izb/footprint_edges.glsl"

// What a texel's centre must be within, for all centres of the tile and some more, so that rounding does not matter.
const float half_tile = 0.5 * float(window_texels);

bool may_touch(vec3 edges[4], Footprint f, ivec2 tile, int layer) {
  vec2 center = (vec2(tile) + 0.5) * float(window_texels);
  bool outside = false;
  for (int i = 0; i < 4; ++i)
    outside = outside || dot(edges[i], vec3(center, 1.0)) + half_tile * (abs(edges[i].x) + abs(edges[i].y)) < 0.0;
#ifdef PYRAMID
  uint furthest = furthest_within(tile * window_texels, tile * window_texels + window_texels - 1, 0, layer);
  float nearest = depth_at(f.base, f.slope, center.x, center.y) - half_tile * (abs(f.slope.x) + abs(f.slope.y));
  outside = outside || max(nearest, 0.0) >= uintBitsToFloat(furthest);
#endif
  return !outside;
}

void main() {
  if (gl_GlobalInvocationID.x >= counts.room.x) return;
  ListedTriangle entry = listed[part_entry(1) + gl_GlobalInvocationID.x];
  entry.node = no_node;
  int layer = int(layer_of(entry));
  vec3 corners[3] = triangle_vs(entry.instance, triangle_of(entry));
#ifdef SPP32
  order_vertices(corners[0], corners[1], corners[2]);
#endif
  Footprint f = make_footprint(face_of_layer(light, layer), windows[layer], corners[0], corners[1], corners[2], dilation);
  ivec4 box = texels_within(f, windows[layer].guard.y);
  vec3 edges[4] = footprint_edges(f);
  ivec2 tile = ivec2(box.x / window_texels, tile_of(entry).y);
#ifdef COUNT
  if (tile.y == box.y / window_texels) atomicAdd(counters.triangles, 1u);
#endif
  int last = box.z / window_texels;
  for (; tile.x <= last; ++tile.x) {
    if (!may_touch(edges, f, tile, layer)) continue;
    entry.place = place_of_tile(tile.x, tile.y);
    uint i = atomicAdd(counts.part[0].w, 1u);
    if (i >= counts.room.z) break;
    if (i % uint(sweep_group) == 0u) atomicAdd(counts.part[0].x, 1u);
    listed[i] = entry;
  }
  if (tile.x > last) return;
  // There was no room: the triangle is drawn, once for all of its rows.
  uint first_row = part_entry(1) + gl_GlobalInvocationID.x - uint(tile.y - box.y / window_texels);
  if (atomicExchange(listed[first_row].node, ~no_node) != no_node) return;
#ifdef COUNT
  atomicAdd(counters.triangles, ~0u);  // the geometry shader counts it
#endif
  entry.place = 0u;
  listed[drawn_entry(atomicAdd(counts.vertices, 3u) / 3u)] = entry;
}
