#version 450 core
// 5.5 Each fragment walks its texel's list, tests each listed pixel against the triangle, and adds shadow to its mask.
// Defines, beside those of receivers.glsl and coverage.glsl: LAYERS: several layers; PIPELINE: fetch one node ahead (6.8);
// COUNT: count fragments and tests; COUNT_TESTS, COUNT_FRAGMENTS: also those of each pixel, of each texel; IN_DOUBLE: decide
// unsure pairs here (when their list overflowed); HW: hardware chose the texels. MASKED: triangles have an alpha mask, see
// cutout.glsl.
#include "shared/bindings.h"
#include "shared/occlusion.h"
#include "shared/pairs.h"
#include "shadow/izb/receivers.glsl"
#ifdef SPP32
#include "shadow/izb/coverage.glsl"
#endif
#ifdef MASKED
#include "shadow/izb/cutout.glsl"
#endif

// Without it fragments that z-cull rejects would still have their side effects.
layout(early_fragment_tests) in;

layout(std140, binding = BIND_CAMERA) uniform CameraBlock { CameraFrame camera; };
layout(std140, binding = BIND_LIGHT) uniform LightBlock { LightFrame light; };
layout(std430, binding = BIND_COUNTERS) buffer CounterBlock { Counters counters; };
layout(std430, binding = BIND_PAIRS) writeonly buffer PairBlock { UnsurePair pairs[]; };
layout(binding = UNIT_ID) uniform usampler2D id_texture;
#ifdef COUNT_TESTS
layout(binding = IMAGE_WORK, r32ui) uniform uimage2D tests_a_pixel;
#endif
#ifdef COUNT_FRAGMENTS
layout(binding = IMAGE_WORK, r32ui) uniform uimage2DArray fragments_a_texel;
#endif

layout(location = 0) flat in vec3 g_a;
layout(location = 1) flat in vec3 g_b;
layout(location = 2) flat in vec3 g_c;
#ifndef HW
layout(location = 3) flat in vec4 g_box;
#endif
layout(location = 4) flat in uvec2 g_id;
#ifdef MASKED
layout(location = 5) flat in vec2 g_uv_a;
layout(location = 6) flat in vec2 g_uv_b;
layout(location = 7) flat in vec2 g_uv_c;

layout(std430, binding = BIND_INSTANCES) readonly buffer InstanceBlock { InstanceFrame instances[]; };
#endif
#ifdef ALPHA_FRAGMENT
layout(std140, binding = BIND_WINDOWS) uniform WindowBlock { LightWindow windows[max_layers]; };
#endif

#ifdef SPP32
#define Planes QuadTriangle
#else
#define Planes TrianglePlanes
#endif

struct Triangle {
  Planes planes;
#ifdef MASKED
  Cutout cutout;
#endif
};

Triangle make_triangle(CameraFrame eye) {
  Triangle t;
#ifdef SPP32
  t.planes = make_quad_triangle(eye, light, g_a, g_b, g_c);
#else
  t.planes = make_planes(light, g_a, g_b, g_c);
#endif
#ifdef MASKED
  t.cutout = make_cutout(instances[g_id.x - 1u].info.y, g_uv_a, g_uv_b, g_uv_c);
#endif
  return t;
}

#ifdef ALPHA_FRAGMENT
bool is_hole(Triangle t, int layer) {
#ifdef CUBE
  LightFrame face = light_face(light, layer / int(light.grid.y));
#else
  LightFrame face = light;
#endif
  dvec3 weights = fragment_weights(face, windows[layer], gl_FragCoord.xy, g_a, g_b, g_c);
  return !is_there(t.cutout.map, texel_of_weights(t.cutout.corners, weights));
}
#endif

void add_pair(ivec2 px) {
  uint i = atomicAdd(counters.pairs, 1u);
  if (i < counters.capacity) pairs[i] = UnsurePair(node_from_pixel(px, 0), g_id.x - 1u, g_id.y, 0u);
}

// The mask bits of one pair.
uint test(CameraFrame eye, Triangle triangle, Receiver r, out bool unsure) {
#ifdef SPP32
  uint bits = classify_quad(eye, triangle.planes, make_micro_quad(eye, r.px, r.data), unsure);
#ifdef IN_DOUBLE
  if (unsure) bits = occluded_bits(quad_planes(eye, light, g_a, g_b, g_c, r.px, r.data));
#endif
#ifdef ALPHA_EXACT
  bits &= ~known_shadow(r.px);  // whose alpha need not be asked
  if (bits != 0u) {
    uint undecided;
    bits = uncut_bits(triangle.cutout, quad_planes(eye, light, g_a, g_b, g_c, r.px, r.data), bits, undecided);
    if (undecided != 0u) counters.unfinished = 1u;
  }
#endif
#else
  vec3 p = receiver_point(eye, vec2(r.px) + 0.5, r.data.x);
  int answer = classify(eye, triangle.planes, p, r.data.x);
  unsure = answer == pair_unsure;
#ifdef IN_DOUBLE
  if (unsure) answer = occludes(eye, light, g_a, g_b, g_c, p, r.data.x) ? pair_in : pair_out;
#endif
#ifdef ALPHA_EXACT
  if (answer == pair_in && !is_uncut(triangle.cutout, light, p, g_a, g_b, g_c)) answer = pair_out;
#endif
  uint bits = answer == pair_in ? 0xffffffffu : 0u;
#endif
#ifdef IN_DOUBLE
  unsure = false;
#endif
  return bits;
}

struct Walk {
  Receiver previous;
  uint node;  // where to go on
  uint tests;
  uint removed;
  uint unchanged;
};

// Tests the pixels of a list; stops at the end, or after a pair that single precision cannot decide. True: such a pair was
// met, `px` is its pixel.
bool walk(CameraFrame eye, Triangle triangle, ivec3 head_texel, inout Walk w, out ivec2 px) {
  bool unsure = false;
#ifdef PIPELINE
  Receiver ahead = load_receiver(w.node);
#endif
  while (w.node != no_node && !unsure) {
#ifdef PIPELINE
    Receiver r = ahead;
    ahead = load_receiver(r.next);
#else
    Receiver r = load_receiver(w.node);
#endif
    w.node = r.next;
    px = r.px;
#ifdef REMOVAL
    if (imageLoad(mask, px).x == 0xffffffffu) {
      unlink_after(w.previous, head_texel, r.next);
      ++w.removed;
      continue;
    }
    w.previous = r;
#endif
    ++w.tests;
#ifdef COUNT_TESTS
    imageAtomicAdd(tests_a_pixel, px, 1u);
#endif
    uint bits = test(eye, triangle, r, unsure);
    if (bits != 0u && !add_shadow(px, bits)) ++w.unchanged;
  }
  return unsure;
}

void main() {
#ifdef HW
  if (g_id.x == 0u) discard;
#else
  if (any(lessThan(gl_FragCoord.xy, g_box.xy)) || any(greaterThan(gl_FragCoord.xy, g_box.zw))) discard;
#endif
  CameraFrame eye = camera;  // read once, not in every round of the loop
  Triangle triangle = make_triangle(eye);
#ifdef LAYERS
  ivec3 head_texel = ivec3(gl_FragCoord.xy, gl_Layer);
#else
  ivec3 head_texel = ivec3(gl_FragCoord.xy, 0);
#endif
#ifdef ALPHA_FRAGMENT
  if (is_hole(triangle, head_texel.z)) discard;
#endif
  Walk w;
  w.previous.node = no_node;
  w.node = load_head(head_texel);
  w.tests = w.removed = w.unchanged = 0u;
  ivec2 px;
  bool unsure = walk(eye, triangle, head_texel, w, px);
#ifndef COUNT
  // Nearly all end here. A machine of lanes pays for a branch that nobody takes, but not for code after a discard of all.
  if (!unsure && w.node == no_node) discard;
#endif
  while (unsure) {
    // A receiver's own triangle, the commonest of them, lies within the bias of its plane and never occludes it.
    if (texelFetch(id_texture, px, 0).xy != g_id) add_pair(px);
    unsure = walk(eye, triangle, head_texel, w, px);
  }
  // llvmpipe ends all loops of an invocation after 65,535 rounds.
  if (unsure || w.node != no_node) counters.unfinished = 1u;
#ifdef COUNT
  if (atomicAdd(counters.fragments, 1u) == 0xffffffffu) atomicAdd(counters.carries, 1u);
  uint tests = atomicAdd(counters.visibility_tests, w.tests);
  if (tests + w.tests < tests) atomicAdd(counters.carries, 1u << 16);
  atomicAdd(counters.removed, w.removed);
  atomicAdd(counters.unchanged, w.unchanged);
#ifdef COUNT_FRAGMENTS
  imageAtomicAdd(fragments_a_texel, head_texel, 1u);
#endif
#endif
}
