#version 450 core
// 5.5 The pairs that single precision left undecided, in double. ALPHA_EXACT: some of the triangles are masked.
#include "shared/bindings.h"
#include "shared/geometry.glsl"
#include "shared/occlusion.h"
#include "shared/pairs.h"
#include "shadow/izb/receivers.glsl"
#ifdef SPP32
#include "shadow/izb/coverage.glsl"
#endif
#ifdef ALPHA_EXACT
#include "shadow/izb/cutout.glsl"
#include "shared/uvs.glsl"
#endif

layout(local_size_x = 64) in;

layout(std140, binding = BIND_CAMERA) uniform CameraBlock { CameraFrame camera; };
layout(std140, binding = BIND_LIGHT) uniform LightBlock { LightFrame light; };
layout(std430, binding = BIND_COUNTERS) buffer CounterBlock { Counters counters; };
layout(std430, binding = BIND_PAIRS) readonly buffer PairBlock { UnsurePair pairs[]; };

void main() {
  uint count = min(counters.pairs, counters.capacity);
  uint threads = gl_NumWorkGroups.x * gl_WorkGroupSize.x;
  for (uint i = gl_GlobalInvocationID.x; i < count; i += threads) {
    UnsurePair pair = pairs[i];
    ivec2 px = pixel_from_node(pair.node);
    vec3 corners[3] = triangle_vs(pair.instance, pair.triangle);
#ifdef ALPHA_EXACT
    vec2 uv[3] = triangle_uvs(pair.instance, pair.triangle);
    uint material = instances[pair.instance].info.y;
    bool masked = is_masked(materials[material]);
#ifdef SPP32
    // As the walk takes them: the same sums in the same order.
    order_with_uvs(corners[0], corners[1], corners[2], uv[0], uv[1], uv[2]);
#endif
    Cutout cutout = make_cutout(material, uv[0], uv[1], uv[2]);
#endif
#ifdef SPP32
    vec4 quad = texelFetch(micro_quad_texture, px, 0);
    QuadPlanes planes = quad_planes(camera, light, corners[0], corners[1], corners[2], px, quad);
    uint bits = occluded_bits(planes);
#ifdef ALPHA_EXACT
    if (masked && bits != 0u) {
      uint undecided;
      bits = uncut_bits(cutout, planes, bits, undecided);
      if (undecided != 0u) counters.unfinished = 1u;
    }
#endif
#else
    float t = texelFetch(eye_distance_texture, px, 0).x;
    vec3 p = receiver_point(camera, vec2(px) + 0.5, t);
    uint bits = occludes(camera, light, corners[0], corners[1], corners[2], p, t) ? 0xffffffffu : 0u;
#ifdef ALPHA_EXACT
    if (masked && bits != 0u && !is_uncut(cutout, light, p, corners[0], corners[1], corners[2])) bits = 0u;
#endif
#endif
    if (bits != 0u) add_shadow(px, bits);
  }
}
