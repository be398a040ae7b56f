#version 450 core
// 5.5 Each fragment walks its texel's list, tests each listed pixel against the triangle, and adds shadow to its mask.
// Defines: COUNT counts fragments and tests; IN_DOUBLE decides every pair in double (when the list of unsure pairs
// overflowed); ZCULL needs early tests, or culled fragments would still have their side effects.
#include "shared/bindings.h"
#include "shared/lists.h"
#include "shared/occlusion.h"
#include "shared/pairs.h"

layout(early_fragment_tests) in;

layout(std140, binding = BIND_CAMERA) uniform CameraBlock { CameraFrame camera; };
layout(std140, binding = BIND_LIGHT) uniform LightBlock { LightFrame light; };
layout(std430, binding = BIND_COUNTERS) buffer CounterBlock { Counters counters; };
layout(std430, binding = BIND_PAIRS) writeonly buffer PairBlock { UnsurePair pairs[]; };
layout(binding = UNIT_HEADS) uniform usampler2D heads;
layout(binding = UNIT_NODES) uniform usampler2D nodes;
layout(binding = UNIT_ID) uniform usampler2D id_texture;
layout(binding = IMAGE_MASK, r32ui) writeonly uniform uimage2D mask;

layout(location = 0) flat in vec3 g_a;
layout(location = 1) flat in vec3 g_b;
layout(location = 2) flat in vec3 g_c;
layout(location = 3) flat in vec4 g_box;
layout(location = 4) flat in uvec2 g_id;

void add_pair(uint node) {
  uint i = atomicAdd(counters.pairs, 1u);
  if (i < counters.capacity) pairs[i] = UnsurePair(node, g_id.x - 1u, g_id.y, 0u);
}

// Tests the pixels of a list from `node` on; stops at the end, or after a pair that single precision cannot decide.
// Returns that pair's node.
uint walk(CameraFrame eye, TrianglePlanes planes, inout uint node, inout uint tests) {
  uint unsure = no_node;
  while (node != no_node && unsure == no_node) {
    uint current = node;
    ivec2 px = pixel_from_node(current);
    uvec2 data = texelFetch(nodes, px, 0).xy;
    node = data.x;
    float t = uintBitsToFloat(data.y);
    vec3 p = receiver_point(eye, vec2(px) + 0.5, t);
    ++tests;
#ifdef IN_DOUBLE
    int answer = occludes(eye, light, g_a, g_b, g_c, p, t) ? pair_in : pair_out;
#else
    int answer = classify(eye, planes, p, t);
#endif
    if (answer == pair_in) imageStore(mask, px, uvec4(0xffffffffu));
    if (answer == pair_unsure) unsure = current;
  }
  return unsure;
}

void main() {
  if (any(lessThan(gl_FragCoord.xy, g_box.xy)) || any(greaterThan(gl_FragCoord.xy, g_box.zw))) discard;
  TrianglePlanes planes = make_planes(light, g_a, g_b, g_c);
  CameraFrame eye = camera;  // read once, not in every round of the loop
  uint node = texelFetch(heads, ivec2(gl_FragCoord.xy), 0).x;
  uint tests = 0u;
  uint unsure = walk(eye, planes, node, tests);
#ifndef COUNT
  // Nearly all end here. A machine of lanes pays for a branch that nobody takes, but not for code after a discard of all.
  if (unsure == no_node) discard;
#endif
  while (unsure != no_node) {
    // A receiver's own triangle, the commonest of them, lies within the bias of its plane and never occludes it.
    if (texelFetch(id_texture, pixel_from_node(unsure), 0).xy != g_id) add_pair(unsure);
    unsure = walk(eye, planes, node, tests);
  }
#ifdef COUNT
  atomicAdd(counters.fragments, 1u);
  atomicAdd(counters.visibility_tests, tests);
#endif
}
