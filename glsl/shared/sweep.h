// SPDX-License-Identifier: MIT
// What --raster compute sorts the triangles into: those that a compute shader sweeps, each for one layer, from the list's
// begin on, and those that the raster pipeline draws, from its end on backwards.
#ifndef IZB_SHARED_SWEEP_H
#define IZB_SHARED_SWEEP_H
#include "shared/footprint.h"
SHARED_BEGIN

struct ListedTriangle {
  uint instance;
  uint triangle_and_layer;  // 16 bits each; no part of a draw list has more triangles
};

// How many there are: as glDispatchComputeIndirect and, from `vertices` on, glDrawArraysIndirect read it.
struct ListedCounts {
  uint groups;
  uint groups_y;
  uint groups_z;
  uint swept;
  uint vertices;
  uint draw_instances;
  uint first_vertex;
  uint first_instance;
};

const int sweep_group = 64;    // invocations
const int list_width = 65536;  // invocations along x that make it: no more than 65,535 groups go along one axis
const int list_size = 1 << 19;
// Triangles times layers at once: of each swept one the driver may end the loops, and then it is drawn, too.
const int most_listed = list_size / 2;

SHARED ListedTriangle make_listed(uint instance, uint triangle, int layer) {
  ListedTriangle t;
  t.instance = instance;
  t.triangle_and_layer = triangle | (uint(layer) << 16);
  return t;
}

SHARED uint triangle_of(IN(ListedTriangle) t) { return t.triangle_and_layer & 0xffffu; }

SHARED uint layer_of(IN(ListedTriangle) t) { return t.triangle_and_layer >> 16; }

// Where drawn triangle n stands.
SHARED uint drawn_entry(uint n) { return uint(list_size) - 1u - n; }

// First and last texel whose centre lies within a footprint's bounds, of a grid of which `side` texels are in use.
SHARED ivec4 texels_within(IN(Footprint) f, float side) {
  vec2 low = clamp(ceil(vec2(f.box.x, f.box.y) - 0.5f), vec2(0.0f), vec2(side));
  vec2 high = clamp(floor(vec2(f.box.z, f.box.w) - 0.5f), vec2(-1.0f), vec2(side - 1.0f));
  return ivec4(int(low.x), int(low.y), int(high.x), int(high.y));
}

SHARED int texel_count(IN(ivec4) box) { return max(box.z - box.x + 1, 0) * max(box.w - box.y + 1, 0); }

SHARED_END
#endif
