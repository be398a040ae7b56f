// The lists of the irregular z-buffer, as the walk reads them, and the mask that it writes.
// Defines: SPP32: micro-quads instead of points; POOL: nodes of exact insertion; REMOVAL: unlink pixels in full shadow (6.6),
// which needs images; SKIP: leave unchanged masks alone (6.7).
#include "shared/lists.h"

#ifdef REMOVAL
layout(binding = IMAGE_HEADS, r32ui) coherent uniform uimage2DArray heads;
#else
layout(binding = UNIT_HEADS) uniform usampler2DArray heads;
#endif

#if defined(SPP32) && !defined(POOL)
#define NODE_TEXEL(node) ivec3(pixel_from_node(node), slot_from_node(node))
#ifdef REMOVAL
layout(binding = IMAGE_NODES, r32ui) coherent uniform uimage2DArray nodes;
#else
layout(binding = UNIT_NODES) uniform usampler2DArray nodes;
#endif
#else
#ifdef POOL
#define NODE_TEXEL(node) pool_texel(node)
#else
#define NODE_TEXEL(node) pixel_from_node(node)
#endif
#ifdef REMOVAL
layout(binding = IMAGE_NODES, rg32ui) coherent uniform uimage2D nodes;
#else
layout(binding = UNIT_NODES) uniform usampler2D nodes;
#endif
#endif

#ifdef SPP32
layout(binding = UNIT_MICRO_QUAD) uniform sampler2D micro_quad_texture;
#endif
layout(binding = IMAGE_MASK, r32ui) coherent uniform uimage2D mask;

// A node as the walk needs it.
struct Receiver {
  uint node;  // no_node: the end
  uint next;
  ivec2 px;
  vec4 data;  // x: eye distance; SPP32: the whole micro-quad
};

uint load_head(ivec3 texel) {
#ifdef REMOVAL
  return imageLoad(heads, texel).x;
#else
  return texelFetch(heads, texel, 0).x;
#endif
}

Receiver load_receiver(uint node) {
  Receiver r;
  r.node = node;
#ifdef REMOVAL
  uvec2 words = imageLoad(nodes, NODE_TEXEL(node)).xy;
#else
  uvec2 words = texelFetch(nodes, NODE_TEXEL(node), 0).xy;
#endif
  r.next = words.x;
#ifdef POOL
  r.px = pixel_from_node(words.y);
#else
  r.px = pixel_from_node(node);
#endif
#ifdef SPP32
  r.data = texelFetch(micro_quad_texture, r.px, 0);
#else
  r.data = vec4(uintBitsToFloat(words.y), 0.0, 0.0, 0.0);
#endif
  return r;
}

#ifdef REMOVAL
// Takes the node after `previous` (or after the head) out of its list, without atomics: every write sets a pointer to a node
// that was reachable from the removed one, so that no live node is lost; what a race brings back only costs time.
void unlink_after(Receiver previous, ivec3 head_texel, uint next) {
  if (previous.node == no_node)
    imageStore(heads, head_texel, uvec4(next));
  else
#ifdef SPP32
#ifdef POOL
    imageStore(nodes, NODE_TEXEL(previous.node), uvec4(next, node_from_pixel(previous.px, 0), 0u, 0u));
#else
    imageStore(nodes, NODE_TEXEL(previous.node), uvec4(next));
#endif
#else
    imageStore(nodes, NODE_TEXEL(previous.node), uvec4(next, floatBitsToUint(previous.data.x), 0u, 0u));
#endif
}
#endif

// Returns whether the word changed, as far as is known.
bool add_shadow(ivec2 px, uint bits) {
#ifdef SPP32
#ifdef SKIP
  if ((bits & ~imageLoad(mask, px).x) == 0u) return false;
#endif
  imageAtomicOr(mask, px, bits);
#else
#ifdef SKIP
  if (imageLoad(mask, px).x == bits) return false;
#endif
  imageStore(mask, px, uvec4(bits));  // all writers write the same word
#endif
  return true;
}
