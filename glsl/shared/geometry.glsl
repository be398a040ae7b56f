// A triangle of the scene by its number, for passes that are not fed by the vertex stage. POSITION_WINDOWS, INDEX_WINDOWS:
// the buffer stands in so many blocks of WINDOW_WORDS words, since one would be larger than the driver takes.
#include "shared/bindings.h"
#include "shared/camera.h"

layout(std430, binding = BIND_INSTANCES) readonly buffer InstanceBlock { InstanceFrame instances[]; };
layout(std430, binding = BIND_POSITIONS) readonly buffer PositionBlock { float positions[]; };
layout(std430, binding = BIND_INDICES) readonly buffer IndexBlock { uint indices[]; };

#ifdef POSITION_WINDOWS
layout(std430, binding = BIND_MORE_POSITIONS) readonly buffer MorePositionBlock {
  float positions[];
} more_positions[POSITION_WINDOWS - 1];

vec3 position_at(uint vertex) {
  uint window = vertex / (WINDOW_WORDS / 3u), i = (vertex % (WINDOW_WORDS / 3u)) * 3u;
  if (window == 0u) return vec3(positions[i], positions[i + 1u], positions[i + 2u]);
  vec3 p = vec3(0.0);
  for (int k = 0; k < POSITION_WINDOWS - 1; ++k)
    if (window == uint(k) + 1u)
      p = vec3(more_positions[k].positions[i], more_positions[k].positions[i + 1u], more_positions[k].positions[i + 2u]);
  return p;
}
#else
vec3 position_at(uint vertex) {
  uint i = vertex * 3u;
  return vec3(positions[i], positions[i + 1u], positions[i + 2u]);
}
#endif

#ifdef INDEX_WINDOWS
layout(std430, binding = BIND_MORE_INDICES) readonly buffer MoreIndexBlock {
  uint indices[];
} more_indices[INDEX_WINDOWS - 1];

uint index_at(uint entry) {
  uint window = entry / WINDOW_WORDS, i = entry % WINDOW_WORDS;
  if (window == 0u) return indices[i];
  uint index = 0u;
  for (int k = 0; k < INDEX_WINDOWS - 1; ++k)
    if (window == uint(k) + 1u) index = more_indices[k].indices[i];
  return index;
}
#else
uint index_at(uint entry) { return indices[entry]; }
#endif

vec3 vertex_vs(InstanceFrame instance, uint corner) {
  return view_from_object(instance, position_at(index_at(corner) + instance.info.w));
}

// Its corners in view space. `instance` is an entry of the instances, `triangle` counts from its first one.
vec3[3] triangle_vs(uint instance, uint triangle) {
  InstanceFrame frame = instances[instance];
  uint first = frame.info.z + triangle * 3u;
  return vec3[3](vertex_vs(frame, first), vertex_vs(frame, first + 1u), vertex_vs(frame, first + 2u));
}

// Whose triangle is number `triangle` of the frame? `count`: of the instances.
uint instance_of(uint triangle, int count) {
  uint low = 0u, high = uint(count);
  while (high - low > 1u) {
    uint middle = (low + high) >> 1;
    if (instances[middle].info.x <= triangle)
      low = middle;
    else
      high = middle;
  }
  return low;
}
