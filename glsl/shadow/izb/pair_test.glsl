// The test of one pair of triangle and pixel, for all who make it: the walk over the lists and the speed of light.
// Defines, beside those of receivers.glsl and coverage.glsl: IN_DOUBLE: decide unsure pairs here; MASKED: triangles may have an
// alpha mask, see cutout.glsl.
#include "shared/occlusion.h"
#include "shared/pairs.h"
#include "shadow/izb/receivers.glsl"
#ifdef SPP32
#include "shadow/izb/coverage.glsl"
#endif
#ifdef MASKED
#include "shadow/izb/cutout.glsl"
#endif

layout(std140, binding = BIND_CAMERA) uniform CameraBlock { CameraFrame camera; };
layout(std140, binding = BIND_LIGHT) uniform LightBlock { LightFrame light; };
layout(std430, binding = BIND_COUNTERS) buffer CounterBlock { Counters counters; };
layout(std430, binding = BIND_PAIRS) writeonly buffer PairBlock { UnsurePair pairs[]; };
layout(binding = UNIT_ID) uniform usampler2D id_texture;

#ifdef SPP32
#define Planes QuadTriangle
#else
#define Planes TrianglePlanes
#endif

// Several samples take the corners in the order of their positions.
struct Triangle {
  vec3 a;
  vec3 b;
  vec3 c;
  Planes planes;
#ifdef MASKED
  Cutout cutout;
  bool masked;
#endif
};

Triangle make_triangle(CameraFrame eye, vec3 a, vec3 b, vec3 c) {
  Triangle t;
  t.a = a;
  t.b = b;
  t.c = c;
#ifdef SPP32
  t.planes = make_quad_triangle(eye, light, a, b, c);
#else
  t.planes = make_planes(light, a, b, c);
#endif
#ifdef MASKED
  t.masked = false;
#endif
  return t;
}

#ifdef MASKED
Triangle make_triangle(CameraFrame eye, vec3 a, vec3 b, vec3 c, Cutout cutout) {
  Triangle t = make_triangle(eye, a, b, c);
  t.cutout = cutout;
  t.masked = true;
  return t;
}
#endif

// A receiver's own triangle, the commonest that single precision cannot decide, lies within the bias of its plane and never
// occludes it; but a lifted micro-quad's does where light comes from behind.
bool is_to_settle(ivec2 px, uvec2 id) {
#ifdef SPP32
  if (texelFetch(micro_quad_texture, px, 0).x != texelFetch(eye_distance_texture, px, 0).x) return true;
#endif
  return texelFetch(id_texture, px, 0).xy != id;
}

void add_pair(ivec2 px, uvec2 id) {
  if (!is_to_settle(px, id)) return;
  uint i = atomicAdd(counters.pairs, 1u);
  if (i < counters.capacity) pairs[i] = UnsurePair(node_from_pixel(px, 0), id.x - 1u, id.y);
}

// The mask bits of one pair, as if the triangle had no alpha mask.
uint test_opaque(CameraFrame eye, Triangle t, ivec2 px, vec4 data, out bool unsure) {
#ifdef SPP32
  uint bits = classify_quad(eye, t.planes, make_micro_quad(eye, px, data), unsure);
#ifdef IN_DOUBLE
  if (unsure) bits = occluded_bits(quad_planes(eye, light, t.a, t.b, t.c, px, data));
#endif
#else
  vec3 p = receiver_point(eye, vec2(px) + 0.5, data.x);
  int answer = classify(eye, t.planes, p, data.x);
  unsure = answer == pair_unsure;
#ifdef IN_DOUBLE
  if (unsure) answer = occludes(eye, light, t.a, t.b, t.c, p, data.x) ? pair_in : pair_out;
#endif
  uint bits = answer == pair_in ? 0xffffffffu : 0u;
#endif
#ifdef IN_DOUBLE
  unsure = false;
#endif
  return bits;
}

// Is the alpha mask to be asked about these bits of the triangle's? Not about those that are dark already.
bool is_alpha_asked(Triangle t, ivec2 px, uint bits) {
#ifdef ALPHA_EXACT
  return t.masked && (bits & ~known_shadow(px)) != 0u;
#else
  return false;
#endif
}

// The mask bits of one pair.
uint test(CameraFrame eye, Triangle t, ivec2 px, vec4 data, out bool unsure) {
  uint bits = test_opaque(eye, t, px, data, unsure);
#ifdef ALPHA_EXACT
  if (is_alpha_asked(t, px, bits)) {
#ifdef SPP32
    uint undecided;
    bits = uncut_bits(t.cutout, quad_planes(eye, light, t.a, t.b, t.c, px, data), bits & ~known_shadow(px), undecided);
#ifdef IN_DOUBLE
    if (undecided != 0u) counters.unfinished = 1u;
#else
    unsure = unsure || undecided != 0u;
#endif
#else
    vec3 p = receiver_point(eye, vec2(px) + 0.5, data.x);
    if (!is_uncut(t.cutout, light, p, t.a, t.b, t.c)) bits = 0u;
#endif
  }
#endif
  return bits;
}
