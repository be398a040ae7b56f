// SPDX-License-Identifier: MIT
// What --raster compute sorts the triangles into: those that a compute shader sweeps, each for one layer, large ones in tiles of
// the grid, and those that the raster pipeline draws. Lanes wait for the one with most to do, so that a sweep goes on for some
// rounds only: what is not done then is listed once more, and the next dispatch has full lanes again.
#ifndef IZB_SHARED_SWEEP_H
#define IZB_SHARED_SWEEP_H
#include "shared/footprint.h"
#include "shared/lists.h"
SHARED_BEGIN

struct ListedTriangle {
  uint instance;
  uint triangle_and_layer;  // 16 bits each; no part of a draw list has more triangles
  uint place;               // the next texel of the sweep, and of which tile
  uint node;                // where the walk over the last one's list goes on
};

const int sweep_parts = 7;

// How many there are.
struct ListedCounts {
  uvec4 part[sweep_parts];  // as glDispatchComputeIndirect reads it: x: groups; w: entries, also those without room
  uvec4 rows;      // likewise, of tiles that are yet to be listed
  uvec4 room;      // x: rows that had room; y: room for rows; z: for entries of a part
  uint vertices;  // from here on as glDrawArraysIndirect reads it
  uint draw_instances;
  uint first_vertex;
  uint first_instance;
};

const int sweep_group = 64;    // invocations
const int list_width = 65536;  // invocations along x that make it: no more than 65,535 groups go along one axis
// Triangles times layers at once.
const int most_listed = 1 << 18;
// The list has room for so many entries of a part and of the next one, which before there is one has the rows of tiles, and for
// as many drawn ones, since of each that is swept the driver may end the loops.
const int part_room = 1 << 20;
const int rows_room = part_room / 2;
const int tiles_room = part_room - most_listed;
const int list_size = 3 * part_room;

// What part k of the sweep reads, and part k - 1 writes, begins there.
SHARED uint part_entry(int k) { return uint((k & 1) * part_room); }

// After how many rounds a part ends, twice as many as the one before; the last one ends none.
SHARED int part_rounds(int k, int parts, int first_rounds) {
  return k == parts - 1 ? 0x7fffffff : first_rounds << k;
}

SHARED ListedTriangle make_listed(uint instance, uint triangle, int layer) {
  ListedTriangle t;
  t.instance = instance;
  t.triangle_and_layer = triangle | (uint(layer) << 16);
  t.place = 0u;
  t.node = no_node;
  return t;
}

// A sweep is over a window of so many texels squared at most: of a triangle that fits, its bounds; of a larger one, a tile of the
// grid, of which `place` holds the column, the row and a bit that says so. Its texels are numbered row by row of eight.
const int window_texels = 8;
const uint place_number = 0x7fu;
const uint place_is_tile = 0x80000000u;

SHARED uint place_of_tile(int column, int row) { return place_is_tile | (uint(column) << 7) | (uint(row) << 18); }

SHARED bool is_tile(IN(ListedTriangle) t) { return (t.place & place_is_tile) != 0u; }

SHARED ivec2 tile_of(IN(ListedTriangle) t) { return ivec2(int((t.place >> 7) & 0x7ffu), int((t.place >> 18) & 0x7ffu)); }

SHARED bool fits_window(IN(ivec4) box) { return box.z - box.x < window_texels && box.w - box.y < window_texels; }

// First and last texel of both.
SHARED ivec4 texels_of_tile(IN(ivec4) box, IN(ivec2) tile) {
  int x = tile.x * window_texels;
  int y = tile.y * window_texels;
  return ivec4(max(box.x, x), max(box.y, y), min(box.z, x + window_texels - 1), min(box.w, y + window_texels - 1));
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
