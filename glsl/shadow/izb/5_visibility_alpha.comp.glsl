#version 450 core
// 5.5 by compute: the pairs whose alpha mask the sweep has left to be asked, one an invocation. COUNT: count masks that were dark
// already.
#include "shared/bindings.h"
#include "shadow/izb/numbered_triangle.glsl"

layout(local_size_x = 64) in;

layout(std430, binding = BIND_ASKED) readonly buffer AskedBlock { UnsurePair asked[]; };

void main() {
  uint count = min(counters.asked, counters.asked_capacity);
  if (gl_GlobalInvocationID.x == 0u && counters.asked > count) atomicMax(counters.pairs, counters.capacity + 1u);
  uint threads = gl_NumWorkGroups.x * gl_WorkGroupSize.x;
  CameraFrame eye = camera;
  for (uint i = gl_GlobalInvocationID.x; i < count; i += threads) {
    UnsurePair pair = asked[i];
    ivec2 px = pixel_from_node(pair.node);
    bool unsure;
    uint bits = test(eye, numbered_triangle(eye, pair.instance, pair.triangle), px, load_data(px), unsure);
    bool changed = bits == 0u || add_shadow(px, bits);
#ifdef COUNT
    if (!changed) atomicAdd(counters.unchanged, 1u);
#endif
    if (unsure) add_pair(px, uvec2(pair.instance + 1u, pair.triangle));
  }
}
