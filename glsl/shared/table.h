// SPDX-License-Identifier: MIT
// The visibility look-up table (4): a line over the pixel to the 32 samples on its positive side. The line is
// f0 + o.x fx + o.y fy = 0, divided by |fx| + |fy|: then it crosses the pixel where its offset lies in (-1/2, 1/2), and its
// direction is a point of the diamond |x| + |y| = 1, so that neither root nor arc tangent is needed. A row holds the
// offsets of one direction, with a column before them for lines beyond the pixel on one side and one after them for the other.
#ifndef IZB_SHARED_TABLE_H
#define IZB_SHARED_TABLE_H
#include "shared/lang.h"
SHARED_BEGIN

SHARED int table_columns(int side) { return side + 2; }

// Entry of the line in a table of `side` directions and offsets. Whole numbers in floats are exact and cheaper here.
SHARED int table_entry(IN(vec3) line, int side) {
  float n = float(side);
  float scale = 1.0f / max(abs(line.y) + abs(line.z), 1.0e-30f);
  float b = line.z * scale;
  float turn = line.y >= 0.0f ? 1.0f + b : 3.0f - b;
  float row = floor(min(turn * (0.25f * n), n - 1.0f));
  float column = floor(clamp(line.x * scale * n + (0.5f * n + 1.0f), 0.0f, n + 1.0f));
  return int(row * (n + 2.0f) + column);
}

// The line at the centre of an entry's bin.
SHARED vec3 table_line(int entry, int side) {
  float turn = (float(entry / table_columns(side)) + 0.5f) * 4.0f / float(side);
  float offset = (float(entry % table_columns(side)) - 0.5f) / float(side) - 0.5f;
  float b = turn < 2.0f ? turn - 1.0f : 3.0f - turn;
  float a = turn < 2.0f ? 1.0f - abs(b) : abs(b) - 1.0f;
  return vec3(offset, a, b);
}

SHARED_END
#endif
