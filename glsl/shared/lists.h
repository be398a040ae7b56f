// SPDX-License-Identifier: MIT
// IZB nodes: a node's address is its pixel and slot, or its number in a pool; 0 ends a list (lanes that are switched off
// read 0 and must stop).
#ifndef IZB_SHARED_LISTS_H
#define IZB_SHARED_LISTS_H
#include "shared/lang.h"
SHARED_BEGIN

const uint no_node = 0u;

// x counts from 1 so that no node is 0: 15 bits; y 14 bits; slot 3 bits.
SHARED uint node_from_pixel(IN(ivec2) px, int slot) {
  return (uint(slot) << 29) | (uint(px.y) << 15) | (uint(px.x) + 1u);
}

SHARED ivec2 pixel_from_node(uint node) { return ivec2(int(node & 0x7fffu) - 1, int((node >> 15) & 0x3fffu)); }

SHARED int slot_from_node(uint node) { return int(node >> 29); }

const int largest_picture_px = 16384;  // along one side

// Where node n (from 1) of a pool stands: a texture, since storage buffers may be small.
const int pool_width = 16384;
SHARED ivec2 pool_texel(uint node) { return ivec2(int(node & 16383u), int(node >> 14)); }

struct PoolCounters {
  uint nodes;
  uint largest_quad;  // texels that one micro-quad touches
  uint carries;       // of `nodes`
  uint unused;
};

// Some software renderers end all loops of an invocation after 65535 rounds together: so many texels of a micro-quad are
// inserted at once, with twice the rows of the largest grid beside them.
const int texels_a_dispatch = 32000;

SHARED_END
#endif
