// SPDX-License-Identifier: MIT
// The z-cull pyramid: levels of 4, 16, 64 ... texels squared up to the largest grid, in one texture: level 0 at the corner,
// the others above one another right of it. One texture without mips, since a fetch whose level varies from lane to lane is
// slow on a software renderer.
#ifndef IZB_SHARED_PYRAMID_H
#define IZB_SHARED_PYRAMID_H
#include "shared/lang.h"
SHARED_BEGIN

const int pyramid_levels = 7;  // the last one's texel is 16384 texels of the grid

// Texels along one side of level k over a grid of `side`.
SHARED int pyramid_side(int side, int k) { return (side + (4 << (2 * k)) - 1) >> (2 * k + 2); }

// Where level k begins.
SHARED ivec2 pyramid_origin(int side, int k) {
  int y = 0;
  for (int below = 1; below < k; ++below) y += pyramid_side(side, below);
  return ivec2(k == 0 ? 0 : pyramid_side(side, 0), y);
}

// Rows of the texture: level 0, or the others above one another where those are more.
SHARED int pyramid_height(int side) {
  ivec2 last = pyramid_origin(side, pyramid_levels - 1);
  return max(pyramid_side(side, 0), last.y + 1);
}

SHARED_END
#endif
