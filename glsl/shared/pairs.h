// SPDX-License-Identifier: MIT
// Triangle-pixel pairs that single precision cannot decide, and the counts of a frame.
#ifndef IZB_SHARED_PAIRS_H
#define IZB_SHARED_PAIRS_H
#include "shared/lists.h"
SHARED_BEGIN

struct Counters {
  uint pairs;             // unsure pairs found; those beyond the capacity are not stored
  uint capacity;
  uint fragments;         // light-space fragments that the visibility shader ran for (counting variant only)
  uint visibility_tests;  // triangle-pixel tests (counting variant only)
  uint triangles;         // triangles that the geometry shader let through (counting variant only)
  uint removed;           // nodes of fully shadowed pixels that were unlinked (counting variant only)
  uint unchanged;         // masks that already had the bits (counting variant only)
  uint unfinished;        // not 0: the driver ended the walk over a list before its end
  uint carries;           // times that fragments (low 16 bits) and visibility_tests (high) have passed 32 bits
  uint stored;            // tests that were to be stored; those beyond the list's end are not (storing variant only)
  uint unstorable;        // not 0: a test's numbers do not fit in its words (storing variant only)
  uint asked;             // pairs whose alpha mask is to be asked; those beyond their capacity are not stored
  uint asked_capacity;
  uint drawn;             // of `triangles`, those that --raster compute left to the raster pipeline (counting variant only)
  uint unused0;
  uint unused1;
};

struct UnsurePair {
  uint node;
  uint instance;  // entry of the instances
  uint triangle;  // of its mesh
};

// A test by its pixel and its triangle, as the G-buffer's id names it (instance + 1, triangle), in two words: 16 bits for the
// triangle, which no part of a draw list exceeds, 19 for the instance, of which the three bits stand where a node has its slot.
const uint storable_instances = 1u << 19;
const uint storable_triangles = 1u << 16;

SHARED bool is_storable(IN(uvec2) id) { return id.x - 1u < storable_instances && id.y < storable_triangles; }

SHARED uvec2 stored_test(IN(ivec2) px, IN(uvec2) id) {
  uint instance = id.x - 1u;
  return uvec2(node_from_pixel(px, int(instance >> 16)), (instance << 16) | id.y);
}

SHARED ivec2 stored_pixel(IN(uvec2) test) { return pixel_from_node(test.x); }

SHARED uvec2 stored_id(IN(uvec2) test) {
  return uvec2(((uint(slot_from_node(test.x)) << 16) | (test.y >> 16)) + 1u, test.y & 0xffffu);
}

// Test n stands at texel (n % tests_a_row, n / tests_a_row) of a texture: storage buffers may be too small.
const int tests_a_row = 16384;

SHARED_END
#endif
