#version 450 core
// 5.5 Each fragment walks its texel's list. Defines, beside those of walk.glsl: LAYERS: several layers; IN_DOUBLE: decide unsure
// pairs here (when their list overflowed); HW: hardware chose the texels. MASKED: triangles have an alpha mask, see cutout.glsl.
#include "shared/bindings.h"
#include "shadow/izb/walk.glsl"

// Without it fragments that z-cull rejects would still have their side effects.
layout(early_fragment_tests) in;

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

Triangle fragment_triangle(CameraFrame eye) {
#ifdef MASKED
  return make_triangle(eye, g_a, g_b, g_c, make_cutout(instances[g_id.x - 1u].info.y, g_uv_a, g_uv_b, g_uv_c));
#else
  return make_triangle(eye, g_a, g_b, g_c);
#endif
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
  Walk w = begin_walk(ivec3(gl_FragCoord.xy, gl_Layer));
#else
  Walk w = begin_walk(ivec3(gl_FragCoord.xy, 0));
#endif
#ifdef ALPHA_FRAGMENT
  if (is_hole(triangle, w.texel)) discard;
#endif
  count_fragment(w);
  w.node = load_head(w.texel);
  bool all = walk_on(eye, triangle, g_id, w);
  // llvmpipe ends all loops of an invocation after 65,535 rounds.
  if (!all || goes_on(w)) counters.unfinished = 1u;
#ifdef COUNT
  add_counts(w);
#endif
}
