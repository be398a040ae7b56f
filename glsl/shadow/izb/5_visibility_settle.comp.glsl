#version 450 core
// 5.5 The pairs that single precision left undecided, in double.
#include "shared/bindings.h"
#include "shared/geometry.glsl"
#include "shared/occlusion.h"
#include "shared/pairs.h"
#include "shadow/izb/receivers.glsl"
#ifdef SPP32
#include "shadow/izb/coverage.glsl"
#endif

layout(local_size_x = 64) in;

layout(std140, binding = BIND_CAMERA) uniform CameraBlock { CameraFrame camera; };
layout(std140, binding = BIND_LIGHT) uniform LightBlock { LightFrame light; };
layout(std430, binding = BIND_COUNTERS) readonly buffer CounterBlock { Counters counters; };
layout(std430, binding = BIND_PAIRS) readonly buffer PairBlock { UnsurePair pairs[]; };
layout(binding = UNIT_EYE_DISTANCE) uniform sampler2D eye_distance_texture;

void main() {
  uint count = min(counters.pairs, counters.capacity);
  uint threads = gl_NumWorkGroups.x * gl_WorkGroupSize.x;
  for (uint i = gl_GlobalInvocationID.x; i < count; i += threads) {
    UnsurePair pair = pairs[i];
    ivec2 px = pixel_from_node(pair.node);
    vec3 corners[3] = triangle_vs(pair.instance, pair.triangle);
#ifdef SPP32
    vec4 quad = texelFetch(micro_quad_texture, px, 0);
    uint bits = occluded_bits(quad_planes(camera, light, corners[0], corners[1], corners[2], px, quad));
#else
    float t = texelFetch(eye_distance_texture, px, 0).x;
    vec3 p = receiver_point(camera, vec2(px) + 0.5, t);
    uint bits = occludes(camera, light, corners[0], corners[1], corners[2], p, t) ? 0xffffffffu : 0u;
#endif
    if (bits != 0u) add_shadow(px, bits);
  }
}
