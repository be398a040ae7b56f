// How the nodes of the lists are stored, for those who write them and those who read them. Defines: SPP32: no eye distance
// in a node, and several nodes a pixel; POOL: nodes of exact insertion.
#include "shared/lists.h"

#if defined(SPP32) && !defined(POOL)
#define NODE_FORMAT r32ui
#define NODE_IMAGE uimage2DArray
#define NODE_SAMPLER usampler2DArray
#define NODE_TEXEL(node) ivec3(pixel_from_node(node), slot_from_node(node))
#else
#define NODE_FORMAT rg32ui
#define NODE_IMAGE uimage2D
#define NODE_SAMPLER usampler2D
#ifdef POOL
#define NODE_TEXEL(node) pool_texel(node)
#else
#define NODE_TEXEL(node) pixel_from_node(node)
#endif
#endif

// What stands there; an image of one word keeps the pointer alone.
uvec4 node_words(uint next, ivec2 px, float t) {
#ifdef POOL
  return uvec4(next, node_from_pixel(px, 0), 0u, 0u);
#else
  return uvec4(next, floatBitsToUint(t), 0u, 0u);
#endif
}
