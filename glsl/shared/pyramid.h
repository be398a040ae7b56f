// SPDX-License-Identifier: MIT
// The z-cull pyramid: three levels in one texture, of 4, 16 and 64 texels squared. One texture without mips, since a fetch
// whose level varies from lane to lane is slow on a software renderer.
#ifndef IZB_SHARED_PYRAMID_H
#define IZB_SHARED_PYRAMID_H
#include "shared/lang.h"
SHARED_BEGIN

const int pyramid_levels = 3;

// Texels along one side of level k over a grid of `side`.
SHARED int pyramid_side(int side, int k) { return (side + (4 << (2 * k)) - 1) >> (2 * k + 2); }

// Where level k begins: 0 at the corner, 1 right of it, 2 above 1.
SHARED ivec2 pyramid_origin(int side, int k) {
  return ivec2(k == 0 ? 0 : pyramid_side(side, 0), k == 2 ? pyramid_side(side, 1) : 0);
}

SHARED_END
#endif
