#version 450 core
// 5.5 without the raster pipeline (--raster compute): an invocation has a triangle of the list (5_visibility_list.comp.glsl) and
// a layer, or a tile of a large one (5_visibility_tiles.comp.glsl), and walks the lists of all texels in its footprint. A
// rasteriser that sets triangles up one after the other, and fills lanes with the fragments of one, is slow where triangles are
// small.
// Defines, beside those of walk.glsl: CUBE: six faces.
#include "shared/bindings.h"
#include "shared/geometry.glsl"
#include "shared/footprint.h"
#include "shared/sweep.h"
#include "shadow/izb/footprint_edges.glsl"
#include "shadow/izb/walk.glsl"
#ifdef MASKED
#include "shared/uvs.glsl"
#endif

layout(local_size_x = 64) in;

layout(location = 1) uniform float dilation;  // texels
layout(location = 2) uniform int part;
layout(location = 3) uniform int most_rounds;
layout(location = 4) uniform bool is_last;

layout(std430, binding = BIND_LISTED) buffer ListedBlock { ListedTriangle listed[]; };
layout(std430, binding = BIND_LISTED_COUNTS) buffer ListedCountBlock { ListedCounts counts; };

#ifdef ZCULL
layout(binding = UNIT_FURTHEST) uniform usampler2DArray furthest;
#endif

// The texels that the footprint may have something to do in, from `number` on: within its edges and, with z-cull, not in front of
// all that is there. In a loop of its own, whose rounds have no test to pay for. What rounding takes from edges and depth is
// less than their guard, which is made for rasterisers.
uvec2 texels_to_sweep(Footprint f, ivec4 box, int layer, int number) {
  vec3 edges[4] = footprint_edges(f);
  uvec2 bits = uvec2(0u);
  ivec2 size = box.zw - box.xy + 1;
  for (ivec2 at = ivec2(0); at.y < size.y && size.x > 0;) {
    vec3 center = vec3(vec2(box.xy + at) + 0.5, 1.0);
    float inside = min(min(dot(edges[0], center), dot(edges[1], center)), min(dot(edges[2], center), dot(edges[3], center)));
    bool takes_part = !(inside < 0.0);
#ifdef ZCULL
    float depth = depth_at(f.base, f.slope, center.x, center.y);
    takes_part = takes_part && max(depth, 0.0) < uintBitsToFloat(texelFetch(furthest, ivec3(box.xy + at, layer), 0).x);
#endif
    int n = at.y * window_texels + at.x;
    uint bit = takes_part && n >= number ? 1u << uint(n & 31) : 0u;
    bits |= n < 32 ? uvec2(bit, 0u) : uvec2(0u, bit);
    at = at.x + 1 < size.x ? ivec2(at.x + 1, at.y) : ivec2(0, at.y + 1);
  }
  return bits;
}

void begin_sweep(Footprint f, ListedTriangle entry, inout Walk w) {
  ivec4 box = texels_within(f, windows[w.texel.z].guard.y);
  if (is_tile(entry)) box = texels_of_tile(box, tile_of(entry));
  w.first = box.xy;
  w.number = int(entry.place & place_number);
  w.texels = texels_to_sweep(f, box, w.texel.z, w.number);
  w.node = entry.node;
  w.resumed = entry.node != no_node;
  if (w.resumed) w.texel.xy = w.first + texel_of_window(w.number - 1);
  w.rounds = most_rounds;
}

// In the next part.
void go_on_later(ListedTriangle entry, Walk w) {
  uint i = atomicAdd(counts.part[part + 1].w, 1u);
  if (i % uint(sweep_group) == 0u) atomicAdd(counts.part[part + 1].x, 1u);
  entry.place = (entry.place & ~place_number) | uint(w.number);
  entry.node = w.node;
  listed[part_entry(part + 1) + i] = entry;
}

void main() {
  if (gl_GlobalInvocationID.x >= min(counts.part[part].w, counts.room.z)) return;
  ListedTriangle entry = listed[part_entry(part) + gl_GlobalInvocationID.x];
  uint instance = entry.instance, number = triangle_of(entry);
  int layer = int(layer_of(entry));
  vec3 corners[3] = triangle_vs(instance, number);
#ifdef MASKED
  vec2 uv[3] = triangle_uvs(instance, number);
#ifdef SPP32
  order_with_uvs(corners[0], corners[1], corners[2], uv[0], uv[1], uv[2]);
#endif
#elif defined(SPP32)
  order_vertices(corners[0], corners[1], corners[2]);
#endif
  Footprint f = make_footprint(face_of_layer(light, layer), windows[layer], corners[0], corners[1], corners[2], dilation);
  Walk w = begin_walk(ivec3(0, 0, layer));
  begin_sweep(f, entry, w);

  CameraFrame eye = camera;
#ifdef MASKED
  Cutout cutout = make_cutout(instances[instance].info.y, uv[0], uv[1], uv[2]);
  Triangle triangle = make_triangle(eye, corners[0], corners[1], corners[2], cutout);
#else
  Triangle triangle = make_triangle(eye, corners[0], corners[1], corners[2]);
#endif
  uvec2 id = uvec2(instance + 1u, number);
  bool all = walk_on(eye, triangle, id, w);
  // llvmpipe ends all loops of an invocation after 65,535 rounds; each fragment has as many of its own.
  bool ended = all && !goes_on(w);
  if (!ended && !is_last)
    go_on_later(entry, w);
  else if (!ended)
    listed[drawn_entry(atomicAdd(counts.vertices, 3u) / 3u)] = entry;
#ifdef COUNT
  if (ended && !is_tile(entry)) atomicAdd(counters.triangles, 1u);
  if (!ended && is_last && is_tile(entry)) atomicAdd(counters.triangles, ~0u);  // the geometry shader counts it again
  add_counts(w);
#endif
}
