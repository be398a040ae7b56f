#version 450 core
// 5.5 by compute: which triangles are swept, as a whole or tile by tile, and which are drawn (shared/sweep.h). What no receiver
// lies behind, or in, is neither, so that the lanes of the sweep are full.
// Defines: SPP32: as the test takes them; CUBE: six faces; PYRAMID: end triangles that no receiver lies behind.
#include "shared/bindings.h"
#include "shared/geometry.glsl"
#include "shared/coverage.h"
#include "shared/sweep.h"

layout(local_size_x = 64) in;

layout(location = 0) uniform uvec2 range;  // triangles in the frame's numbering
layout(location = 1) uniform float dilation;  // texels
layout(location = 2) uniform int instance_count;
layout(location = 3) uniform int most_texels;

layout(std140, binding = BIND_LIGHT) uniform LightBlock { LightFrame light; };
layout(std140, binding = BIND_WINDOWS) uniform WindowBlock { LightWindow windows[max_layers]; };
layout(std430, binding = BIND_LISTED) writeonly buffer ListedBlock { ListedTriangle listed[]; };
layout(std430, binding = BIND_LISTED_COUNTS) buffer ListedCountBlock { ListedCounts counts; };
#ifdef PYRAMID
#include "shadow/izb/behind_all.glsl"
#endif

void list_drawn(ListedTriangle entry) { listed[drawn_entry(atomicAdd(counts.vertices, 3u) / 3u)] = entry; }

// The rows of tiles that the triangle touches, for 5_visibility_tiles.comp.glsl.
void list_rows(ListedTriangle entry, ivec4 box) {
  int first = box.y / window_texels;
  uint rows = uint(box.w / window_texels - first + 1);
  uint i = atomicAdd(counts.rows.w, rows);
  if (i + rows > counts.room.y) {
    list_drawn(entry);
    return;
  }
  for (uint row = 0u; row < rows; ++row) {
    entry.place = place_of_tile(0, first + int(row));
    listed[part_entry(1) + i + row] = entry;
  }
  atomicMax(counts.room.x, i + rows);
  atomicMax(counts.rows.x, (i + rows + uint(sweep_group) - 1u) / uint(sweep_group));
}

void main() {
  uint n = range.x + gl_GlobalInvocationID.y * uint(list_width) + gl_GlobalInvocationID.x;
  int layer = int(gl_WorkGroupID.z);
  if (n >= range.y || windows[layer].guard.y == 0.0) return;
  uint instance = instance_of(n, instance_count), number = n - instances[instance].info.x;
  vec3 corners[3] = triangle_vs(instance, number);
  if (holds_light(light, corners[0], corners[1], corners[2])) return;
#ifdef SPP32
  order_vertices(corners[0], corners[1], corners[2]);
#endif
  Footprint f = make_footprint(face_of_layer(light, layer), windows[layer], corners[0], corners[1], corners[2], dilation);
  if (f.count == 0) return;
#ifdef PYRAMID
  if (behind_all(f, layer)) return;
#endif
  bool bounded = f.box.x < f.box.z && f.box.y < f.box.w;  // no NaN
  ListedTriangle entry = make_listed(instance, number, layer);
  ivec4 box = texels_within(f, windows[layer].guard.y);
  if (!bounded || texel_count(box) > most_texels) {
    list_drawn(entry);
  } else if (!fits_window(box)) {
    list_rows(entry, box);
  } else {
    uint i = atomicAdd(counts.part[0].w, 1u);
    if (i % uint(sweep_group) == 0u) atomicAdd(counts.part[0].x, 1u);
    listed[i] = entry;
  }
}
