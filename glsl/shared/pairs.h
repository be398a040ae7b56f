// SPDX-License-Identifier: MIT
// Triangle-pixel pairs that single precision cannot decide, and the counts of a frame.
#ifndef IZB_SHARED_PAIRS_H
#define IZB_SHARED_PAIRS_H
#include "shared/lang.h"
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
  uint unused0;
  uint unused1;
  uint unused2;
};

struct UnsurePair {
  uint node;
  uint instance;  // entry of the instances
  uint triangle;  // of its mesh
  uint unused;
};

SHARED_END
#endif
