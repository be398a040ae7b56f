#version 450 core
// 5.5 Each fragment walks its texel's list, tests each listed pixel against the triangle, and adds shadow to its mask.
// Defines, beside those of receivers.glsl and coverage.glsl: LAYERS: several layers; PIPELINE: fetch one node ahead (6.8);
// COUNT: count fragments and tests; COUNT_TESTS, COUNT_FRAGMENTS: also those of each pixel, of each texel; STORE_TESTS: store
// each test for 5_visibility_speed_of_light.comp.glsl; IN_DOUBLE: decide unsure pairs here (when their list overflowed); HW:
// hardware chose the texels. MASKED: triangles have an alpha mask, see cutout.glsl.
#include "shared/bindings.h"
#include "shadow/izb/pair_test.glsl"

// Without it fragments that z-cull rejects would still have their side effects.
layout(early_fragment_tests) in;

#ifdef COUNT_TESTS
layout(binding = IMAGE_WORK, r32ui) uniform uimage2D tests_a_pixel;
#endif
#ifdef COUNT_FRAGMENTS
layout(binding = IMAGE_WORK, r32ui) uniform uimage2DArray fragments_a_texel;
#endif
#ifdef STORE_TESTS
layout(binding = IMAGE_WORK, rg32ui) writeonly uniform uimage2D stored_tests;
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

Triangle fragment_triangle(CameraFrame eye) {
#ifdef MASKED
  return make_triangle(eye, g_a, g_b, g_c, make_cutout(instances[g_id.x - 1u].info.y, g_uv_a, g_uv_b, g_uv_c));
#else
  return make_triangle(eye, g_a, g_b, g_c);
#endif
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

#ifdef STORE_TESTS
void store_test(ivec2 px) {
  int i = int(atomicAdd(counters.stored, 1u));
  if (!is_storable(g_id)) counters.unstorable = 1u;
  // A store beyond the image's end has no effect.
  imageStore(stored_tests, ivec2(i % tests_a_row, i / tests_a_row), uvec4(stored_test(px, g_id), 0u, 0u));
}
#endif

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
#ifdef STORE_TESTS
    store_test(px);
#endif
    uint bits = test(eye, triangle, r.px, r.data, unsure);
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
  Triangle triangle = fragment_triangle(eye);
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
    add_pair(px, g_id);
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
