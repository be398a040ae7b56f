#version 450 core
// 5.5 without the raster pipeline (--raster compute): an invocation has a triangle of the list (5_visibility_list.comp.glsl) and
// a layer, and walks the lists of all texels in the triangle's footprint. A rasteriser that sets triangles up one after the
// other, and fills lanes with the fragments of one, is slow where triangles are small.
// Defines, beside those of walk.glsl: CUBE: six faces.
#include "shared/bindings.h"
#include "shared/geometry.glsl"
#include "shared/footprint.h"
#include "shared/sweep.h"
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

vec3 edge_of(vec3 p, vec3 q, float turn) {
  vec2 n = vec2(p.y - q.y, q.x - p.x) * turn;
  return vec3(n, -dot(n, p.xy));
}

// Bounds, edges and depth of the footprint. What rounding takes from these is less than its guard, which is made for
// rasterisers.
void begin_sweep(Footprint f, ListedTriangle entry, inout Walk w) {
  w.box = texels_within(f, windows[w.texel.z].guard.y);
  int columns = max(w.box.z - w.box.x + 1, 1), behind = int(entry.texels) - 1;
  w.texel.xy = w.box.xy + (behind < 0 ? ivec2(-1, 0) : ivec2(behind % columns, behind / columns));
  w.texels = texel_count(w.box) - int(entry.texels);
  w.node = entry.node;
  w.resumed = entry.node != no_node;
  w.rounds = most_rounds;
  w.base = f.base;
  w.slope = f.slope;

  vec3 last = f.count == 4 ? f.p3 : f.p2;
  vec2 u = f.p1.xy - f.p0.xy, v = f.p2.xy - f.p0.xy;
  float turn = u.x * v.y - u.y * v.x < 0.0 ? -1.0 : 1.0;
  w.edge[0] = edge_of(f.p0, f.p1, turn);
  w.edge[1] = edge_of(f.p1, last, turn);
  w.edge[2] = edge_of(last, f.p2, turn);
  w.edge[3] = edge_of(f.p2, f.p0, turn);
}

// In the next part.
void go_on_later(ListedTriangle entry, Walk w) {
  uint i = atomicAdd(counts.part[part + 1].w, 1u);
  if (i % uint(sweep_group) == 0u) atomicAdd(counts.part[part + 1].x, 1u);
  entry.texels = uint(texel_count(w.box) - w.texels);
  entry.node = w.node;
  listed[part_entry(part + 1) + i] = entry;
}

void main() {
  if (gl_GlobalInvocationID.x >= counts.part[part].w) return;
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
  if (ended) atomicAdd(counters.triangles, 1u);
  add_counts(w);
#endif
}
