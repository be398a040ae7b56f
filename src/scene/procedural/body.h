// SPDX-License-Identifier: MIT
// A human body as one smooth surface over a skeleton: round cones melt into each other, and the surface where their
// field is zero is cut into triangles by surface nets (Gibson 1998).
#pragma once
#include <array>
#include <vector>

#include "scene/procedural/builder.h"
#include "scene/procedural/rig.h"

namespace izb::procedural {

enum Bone {
  hips,
  spine,
  chest,
  neck,
  head,
  left_arm,
  left_forearm,
  left_hand,
  right_arm,
  right_forearm,
  right_hand,
  left_thigh,
  left_shin,
  left_foot,
  right_thigh,
  right_shin,
  right_foot,
  bone_count
};

struct BoneShape {
  const char* name;
  int parent;           ///< -1: the root
  glm::dvec3 from, to;  ///< at rest: standing on y = 0, facing +z, arms held off
};
const std::array<BoneShape, bone_count>& skeleton();

enum Cloth { skin, hair, shirt, trousers, shoes, cloth_count };

struct Body {
  std::vector<glm::dvec3> positions, normals;
  std::vector<Influence> influences;                         ///< one a position; joints are bones
  std::array<std::vector<uint32_t>, cloth_count> triangles;  ///< three indices each
};

/// The body in cells of `cell_m`; and how many triangles that makes, about.
Body make_body(double cell_m);
size_t body_triangles(double cell_m);

}  // namespace izb::procedural
