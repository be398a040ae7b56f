// The walk over lists, for fragments (5_visibility.frag.glsl) and for invocations that have a triangle each
// (5_visibility.comp.glsl): tests each listed pixel against the triangle, and adds shadow to its mask.
// Defines, beside those of pair_test.glsl: PIPELINE: fetch one node ahead (6.8); SWEEP: over the lists of many texels;
// COUNT: count fragments and tests; COUNT_TESTS, COUNT_FRAGMENTS: also those of each
// pixel, of each texel; STORE_TESTS: store each test for 5_visibility_speed_of_light.comp.glsl.
#include "shadow/izb/pair_test.glsl"

#ifdef COUNT_TESTS
layout(binding = IMAGE_WORK, r32ui) uniform uimage2D tests_a_pixel;
#endif
#ifdef COUNT_FRAGMENTS
layout(binding = IMAGE_WORK, r32ui) uniform uimage2DArray fragments_a_texel;
#endif
#ifdef STORE_TESTS
layout(binding = IMAGE_WORK, rg32ui) writeonly uniform uimage2D stored_tests;

void store_test(ivec2 px, uvec2 id) {
  int i = int(atomicAdd(counters.stored, 1u));
  if (!is_storable(id)) counters.unstorable = 1u;
  // A store beyond the image's end has no effect.
  imageStore(stored_tests, ivec2(i % tests_a_row, i / tests_a_row), uvec4(stored_test(px, id), 0u, 0u));
}
#endif

#if defined(ALPHA_FRAGMENT) || defined(SWEEP)
layout(std140, binding = BIND_WINDOWS) uniform WindowBlock { LightWindow windows[max_layers]; };
#endif
#ifdef ALPHA_FRAGMENT
// Is the triangle not there at the texel's centre?
bool is_hole(Triangle t, ivec3 texel) {
  dvec3 weights = fragment_weights(face_of_layer(light, texel.z), windows[texel.z], vec2(texel.xy) + 0.5, t.a, t.b, t.c);
  return !is_there(t.cutout.map, texel_of_weights(t.cutout.corners, weights));
}
#endif

struct Walk {
  ivec3 texel;
  Receiver previous;
  uint node;  // where to go on
#ifdef SWEEP
  int rounds;    // that are left
  uvec2 texels;  // that are left, a bit each
  int number;    // of the next one, if it is one of them
  ivec2 first;   // texel of the window
  bool resumed;  // within a list, whose node before is not known
#endif
  uint fragments;
  uint tests;
  uint removed;
  uint unchanged;
};

Walk begin_walk(ivec3 texel) {
  Walk w;
  w.texel = texel;
  w.previous.node = no_node;
  w.node = no_node;
  w.fragments = w.tests = w.removed = w.unchanged = 0u;
#ifdef SWEEP
  w.texels = uvec2(0u);
  w.number = 0;
  w.first = ivec2(0);
  w.rounds = 0;
  w.resumed = false;
#endif
  return w;
}

void count_fragment(inout Walk w) {
#ifdef COUNT
  ++w.fragments;
#ifdef COUNT_FRAGMENTS
  imageAtomicAdd(fragments_a_texel, w.texel, 1u);
#endif
#endif
}

bool goes_on(Walk w) {
#ifdef SWEEP
  return w.node != no_node || (w.texels.x | w.texels.y) != 0u;
#else
  return w.node != no_node;
#endif
}

bool has_rounds(Walk w) {
#ifdef SWEEP
  return w.rounds > 0;
#else
  return true;
#endif
}

#ifdef SWEEP
ivec2 texel_of_window(int number) { return ivec2(number % window_texels, number / window_texels); }

// Goes to the next texel that is left, to the head of its list.
void next_texel(Triangle triangle, inout Walk w) {
  int n = w.texels.x != 0u ? findLSB(w.texels.x) : findLSB(w.texels.y) + 32;
  if (w.texels.x != 0u)
    w.texels.x &= w.texels.x - 1u;
  else
    w.texels.y &= w.texels.y - 1u;
  w.number = n + 1;
  w.texel.xy = w.first + texel_of_window(n);
  uint head = load_head(w.texel);
#ifdef ALPHA_FRAGMENT
  if (is_hole(triangle, w.texel)) return;
#endif
  count_fragment(w);
  w.previous.node = no_node;
  w.resumed = false;
  w.node = head;
}
#endif

// Pairs that take more than the walk's rounds should: those that single precision cannot decide, and those whose alpha mask is to
// be asked. All lanes of a round pay for what one of them does; put off, the few are paid for side by side.
struct PutOff {
  uvec4 pixels;  // as node_from_pixel packs them, the last one first
  int count;
};

const int put_off_room = 4;

// Stops at the end, or where no more can be put off.
void walk(CameraFrame eye, Triangle triangle, uvec2 id, inout Walk w, out PutOff put_off) {
  put_off.pixels = uvec4(0u);
  put_off.count = 0;
#ifdef PIPELINE
  Receiver ahead = load_receiver(w.node);
#endif
  while (goes_on(w) && has_rounds(w) && put_off.count < put_off_room) {
#ifdef SWEEP
    --w.rounds;
    // In the same loop: with one of its own, all lanes would wait for the one that skips most.
    if (w.node == no_node) next_texel(triangle, w);
    if (w.node == no_node) continue;
#endif
#ifdef PIPELINE
    Receiver r = ahead;
    ahead = load_receiver(r.next);
#else
    Receiver r = load_receiver(w.node);
#endif
    w.node = r.next;
#ifdef REMOVAL
    if (imageLoad(mask, r.px).x == 0xffffffffu) {
#ifdef SWEEP
      if (w.resumed) continue;
#endif
      unlink_after(w.previous, w.texel, r.next);
      ++w.removed;
      continue;
    }
    w.previous = r;
#ifdef SWEEP
    w.resumed = false;
#endif
#endif
    ++w.tests;
#ifdef COUNT_TESTS
    imageAtomicAdd(tests_a_pixel, r.px, 1u);
#endif
#ifdef STORE_TESTS
    store_test(r.px, id);
#endif
    bool later;
    uint bits = test_opaque(eye, triangle, r.px, r.data, later);
#ifdef ALPHA_EXACT
    later = later || is_alpha_asked(triangle, r.px, bits);
    if (triangle.masked) bits = 0u;
#endif
    if (bits != 0u && !add_shadow(r.px, bits)) ++w.unchanged;
    if (later) {
      put_off.pixels = uvec4(node_from_pixel(r.px, 0), put_off.pixels.xyz);
      ++put_off.count;
    }
  }
}

#if defined(ALPHA_EXACT) && defined(SWEEP)
layout(std430, binding = BIND_ASKED) writeonly buffer AskedBlock { UnsurePair asked[]; };

void ask(uint i, uint node, uvec2 id) {
  if (i < counters.asked_capacity) asked[i] = UnsurePair(node, id.x - 1u, id.y);
}

// Into the list of 5_visibility_alpha.comp.glsl, whose lanes are full. No loop: a driver that ends it would leave places there that
// nobody has written.
void take_all(CameraFrame eye, Triangle triangle, uvec2 id, inout Walk w, inout PutOff put_off) {
  if (put_off.count == 0) return;
  uint i = atomicAdd(counters.asked, uint(put_off.count));
  ask(i, put_off.pixels.x, id);
  if (put_off.count > 1) ask(i + 1u, put_off.pixels.y, id);
  if (put_off.count > 2) ask(i + 2u, put_off.pixels.z, id);
  if (put_off.count > 3) ask(i + 3u, put_off.pixels.w, id);
  put_off.count = 0;
}
#else
// Takes the last pair that was put off.
void take(CameraFrame eye, Triangle triangle, uvec2 id, inout Walk w, inout PutOff put_off) {
  ivec2 px = pixel_from_node(put_off.pixels.x);
  put_off.pixels = put_off.pixels.yzww;
  --put_off.count;
#ifdef ALPHA_EXACT
  if (triangle.masked) {
    bool unsure;
    uint bits = test(eye, triangle, px, load_data(px), unsure);
    if (bits != 0u && !add_shadow(px, bits)) ++w.unchanged;
    if (!unsure) return;
  }
#endif
  add_pair(px, id);
}

void take_all(CameraFrame eye, Triangle triangle, uvec2 id, inout Walk w, inout PutOff put_off) {
  while (put_off.count > 0) take(eye, triangle, id, w, put_off);
}
#endif

// To the end of the list (SWEEP: or of the rounds), with all that it puts off. False: a driver's limit of loops ended it before.
bool walk_on(CameraFrame eye, Triangle triangle, uvec2 id, inout Walk w) {
  bool full;
  PutOff put_off;
  do {
    walk(eye, triangle, id, w, put_off);
    full = put_off.count == put_off_room;
    take_all(eye, triangle, id, w, put_off);
  } while (full);
  return !full && put_off.count == 0;
}

#ifdef COUNT
void add_counts(Walk w) {
  uint fragments = atomicAdd(counters.fragments, w.fragments);
  if (fragments + w.fragments < fragments) atomicAdd(counters.carries, 1u);
  uint tests = atomicAdd(counters.visibility_tests, w.tests);
  if (tests + w.tests < tests) atomicAdd(counters.carries, 1u << 16);
  atomicAdd(counters.removed, w.removed);
  atomicAdd(counters.unchanged, w.unchanged);
}
#endif
