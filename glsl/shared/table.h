// SPDX-License-Identifier: MIT
// The visibility look-up table (4): a line over the pixel to the 32 samples on its positive side. The line is
// f0 + o.x fx + o.y fy = 0, divided by |fx| + |fy|: then it crosses the pixel where its offset lies in (-1/2, 1/2), and its
// direction is a point of the diamond |x| + |y| = 1, so that neither root nor arc tangent is needed.
#ifndef IZB_SHARED_TABLE_H
#define IZB_SHARED_TABLE_H
#include "shared/lang.h"
SHARED_BEGIN

const int table_none = -1;  // the line leaves all samples on its negative side
const int table_all = -2;

// Entry of the line in a table of side x side, or table_none, table_all.
SHARED int table_entry(IN(vec3) line, int side) {
  float size = abs(line.y) + abs(line.z);
  if (line.x >= 0.5f * size) return table_all;  // also lines without a direction
  if (line.x <= -0.5f * size) return table_none;
  float a = line.y / size;
  float b = line.z / size;
  float turn = a >= 0.0f ? (b >= 0.0f ? b : 4.0f + b) : 2.0f - b;
  int direction = min(int(turn * 0.25f * float(side)), side - 1);
  int offset = min(int((line.x / size + 0.5f) * float(side)), side - 1);
  return direction * side + offset;
}

// The line at the centre of an entry's bin.
SHARED vec3 table_line(int entry, int side) {
  float turn = (float(entry / side) + 0.5f) * 4.0f / float(side);
  float offset = (float(entry % side) + 0.5f) / float(side) - 0.5f;
  float b = turn < 1.0f ? turn : (turn < 3.0f ? 2.0f - turn : turn - 4.0f);
  float a = turn < 1.0f || turn >= 3.0f ? 1.0f - abs(b) : abs(b) - 1.0f;
  return vec3(offset, a, b);
}

SHARED_END
#endif
