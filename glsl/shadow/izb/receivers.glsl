// The lists of the irregular z-buffer, as the walk reads them, and the mask that it writes.
// Defines: SPP32: micro-quads instead of points; POOL: nodes of exact insertion; REMOVAL: unlink pixels in full shadow (6.6),
// which needs images; SKIP: leave unchanged masks alone (6.7).
#include "shadow/izb/nodes.glsl"

#ifdef REMOVAL
layout(binding = IMAGE_HEADS, r32ui) coherent uniform uimage2DArray heads;
layout(binding = IMAGE_NODES, NODE_FORMAT) coherent uniform NODE_IMAGE nodes;
#define LOAD(texture, texel) imageLoad(texture, texel)
#else
layout(binding = UNIT_HEADS) uniform usampler2DArray heads;
layout(binding = UNIT_NODES) uniform NODE_SAMPLER nodes;
#define LOAD(texture, texel) texelFetch(texture, texel, 0)
#endif
#ifdef SPP32
layout(binding = UNIT_MICRO_QUAD) uniform sampler2D micro_quad_texture;
#endif
layout(binding = UNIT_EYE_DISTANCE) uniform sampler2D eye_distance_texture;
layout(binding = IMAGE_MASK, r32ui) coherent uniform uimage2D mask;

// A node as the walk needs it.
struct Receiver {
  uint node;  // no_node: the end
  uint next;
  ivec2 px;
  vec4 data;  // x: eye distance; SPP32: the whole micro-quad
};

// Of a pixel, as a node's.
vec4 load_data(ivec2 px) {
#ifdef SPP32
  return texelFetch(micro_quad_texture, px, 0);
#else
  return vec4(texelFetch(eye_distance_texture, px, 0).x, 0.0, 0.0, 0.0);
#endif
}

uint load_head(ivec3 texel) { return LOAD(heads, texel).x; }

Receiver load_receiver(uint node) {
  Receiver r;
  r.node = node;
  uvec2 words = LOAD(nodes, NODE_TEXEL(node)).xy;
  r.next = words.x;
#ifdef POOL
  r.px = pixel_from_node(words.y);
#else
  r.px = pixel_from_node(node);
#endif
#ifdef SPP32
  r.data = load_data(r.px);
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
    imageStore(nodes, NODE_TEXEL(previous.node), node_words(next, previous.px, previous.data.x));
}
#endif

// Bits that the mask has, as far as is known, if the options allow to look.
uint known_shadow(ivec2 px) {
#if defined(REMOVAL) || defined(SKIP)
  return imageLoad(mask, px).x;
#else
  return 0u;
#endif
}

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
