#version 450 core
// 5.5 The pairs that single precision left undecided, in double.
#include "shared/bindings.h"
#include "shared/geometry.glsl"
#include "shared/lists.h"
#include "shared/occlusion.h"
#include "shared/pairs.h"

layout(local_size_x = 64) in;

layout(std140, binding = BIND_CAMERA) uniform CameraBlock { CameraFrame camera; };
layout(std140, binding = BIND_LIGHT) uniform LightBlock { LightFrame light; };
layout(std430, binding = BIND_COUNTERS) readonly buffer CounterBlock { Counters counters; };
layout(std430, binding = BIND_PAIRS) readonly buffer PairBlock { UnsurePair pairs[]; };
layout(binding = UNIT_EYE_DISTANCE) uniform sampler2D eye_distance_texture;
layout(binding = IMAGE_MASK, r32ui) writeonly uniform uimage2D mask;

void main() {
  uint count = min(counters.pairs, counters.capacity);
  uint threads = gl_NumWorkGroups.x * gl_WorkGroupSize.x;
  for (uint i = gl_GlobalInvocationID.x; i < count; i += threads) {
    UnsurePair pair = pairs[i];
    ivec2 px = pixel_from_node(pair.node);
    float t = texelFetch(eye_distance_texture, px, 0).x;
    vec3 p = receiver_point(camera, vec2(px) + 0.5, t);
    vec3 corners[3] = triangle_vs(pair.instance, pair.triangle);
    if (occludes(camera, light, corners[0], corners[1], corners[2], p, t))
      imageStore(mask, px, uvec4(0xffffffffu));
  }
}
