// A triangle of the scene by its number, for passes that are not fed by the vertex stage.
#include "shared/bindings.h"
#include "shared/camera.h"

layout(std430, binding = BIND_INSTANCES) readonly buffer InstanceBlock { InstanceFrame instances[]; };
layout(std430, binding = BIND_POSITIONS) readonly buffer PositionBlock { float positions[]; };
layout(std430, binding = BIND_INDICES) readonly buffer IndexBlock { uint indices[]; };

vec3 vertex_vs(InstanceFrame instance, uint corner) {
  uint i = (indices[corner] + instance.info.w) * 3u;
  return view_from_object(instance, vec3(positions[i], positions[i + 1u], positions[i + 2u]));
}

// Its corners in view space. `instance` is an entry of the instances, `triangle` counts in the instance's mesh.
vec3[3] triangle_vs(uint instance, uint triangle) {
  InstanceFrame frame = instances[instance];
  uint first = frame.info.z + triangle * 3u;
  return vec3[3](vertex_vs(frame, first), vertex_vs(frame, first + 1u), vertex_vs(frame, first + 2u));
}
