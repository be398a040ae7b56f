// SPDX-License-Identifier: MIT
// IZB nodes: a node's address is its pixel; 0 ends a list (lanes that are switched off read 0 and must stop).
#ifndef IZB_SHARED_LISTS_H
#define IZB_SHARED_LISTS_H
#include "shared/lang.h"
SHARED_BEGIN

const uint no_node = 0u;

// 16 bits a coordinate; x counts from 1 so that no node is 0.
SHARED uint node_from_pixel(IN(ivec2) px) { return (uint(px.y) << 16) | (uint(px.x) + 1u); }

SHARED ivec2 pixel_from_node(uint node) { return ivec2(int(node & 0xffffu) - 1, int(node >> 16)); }

// What stands in the grid of nodes for a pixel that is in no list: above every node.
SHARED uint not_a_node(uint pixel_class) { return 0xfffffff0u + pixel_class; }

SHARED_END
#endif
