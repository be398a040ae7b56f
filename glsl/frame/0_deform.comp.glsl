#version 450 core
// Before 5.1: the vertices of one instance that deforms, morphed and skinned. Every stage reads what is written here.
#include "shared/bindings.h"
#include "shared/deform.h"

layout(local_size_x = 64) in;

layout(std430, binding = BIND_REST_POSITIONS) readonly buffer RestPositionBlock { float rest_positions[]; };
layout(std430, binding = BIND_REST_NORMALS) readonly buffer RestNormalBlock { float rest_normals[]; };
layout(std430, binding = BIND_TARGETS) readonly buffer TargetBlock { float targets[]; };  // positions, normals; of each
layout(std430, binding = BIND_INFLUENCES) readonly buffer InfluenceBlock { InfluenceFrame influences[]; };
layout(std430, binding = BIND_JOINTS) readonly buffer JointBlock { JointFrame joints[]; };
layout(std430, binding = BIND_MORPH_WEIGHTS) readonly buffer MorphWeightBlock { float morph_weights[]; };
layout(std430, binding = BIND_DEFORMED_POSITIONS) writeonly buffer DeformedPositionBlock { float deformed_positions[]; };
layout(std430, binding = BIND_DEFORMED_NORMALS) writeonly buffer DeformedNormalBlock { float deformed_normals[]; };

layout(location = 0) uniform uint vertex_count;
layout(location = 1) uniform uint influence_count;  // of each vertex
layout(location = 2) uniform uint target_count;

vec3 difference(uint array, uint vertex) {
  uint i = (array * vertex_count + vertex) * 3u;
  return vec3(targets[i], targets[i + 1u], targets[i + 2u]);
}

void main() {
  uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
  uint v = group * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
  if (v >= vertex_count) return;
  uint i = v * 3u;
  vec3 position = vec3(rest_positions[i], rest_positions[i + 1u], rest_positions[i + 2u]);
  vec3 normal = vec3(rest_normals[i], rest_normals[i + 1u], rest_normals[i + 2u]);
  for (uint t = 0u; t < target_count; ++t) {
    if (morph_weights[t] == 0.0) continue;
    position = morphed(position, morph_weights[t], difference(2u * t, v));
    normal = morphed(normal, morph_weights[t], difference(2u * t + 1u, v));
  }
  if (influence_count > 0u) {
    JointFrame skin = JointFrame(vec4(0.0), vec4(0.0), vec4(0.0));
    for (uint k = v * influence_count; k < (v + 1u) * influence_count; ++k)
      add_joint(skin, influences[k].weight, joints[influences[k].joint]);
    position = skinned_position(skin, position);
    normal = skinned_normal(skin, normal);
  }
  deformed_positions[i] = position.x;
  deformed_positions[i + 1u] = position.y;
  deformed_positions[i + 2u] = position.z;
  deformed_normals[i] = normal.x;
  deformed_normals[i + 1u] = normal.y;
  deformed_normals[i + 2u] = normal.z;
}
