// SPDX-License-Identifier: MIT
// Joints, skins and key frames of the scenes that deform.
#pragma once
#include <array>
#include <vector>

#include "scene/procedural/builder.h"

namespace izb::procedural {

/// What a vertex follows: up to four joints of the skin, with weights of the sum 1. Unused ones are 0.
struct Influence {
  std::array<uint16_t, 4> joints{};
  std::array<float, 4> weights{};
};

/// A new node at `translation` from its parent, which comes before it or is -1.
uint32_t add_node(Scene& scene, const char* name, int parent, const glm::dvec3& translation);

/// A skin of these nodes in their pose at rest.
int add_skin(Scene& scene, const std::vector<uint32_t>& joints);

/// A skinned mesh; `influences` has one entry a vertex.
void add_skinned(Scene& scene, Mesh mesh, const std::vector<Influence>& influences, int skin);

glm::dquat about(const glm::dvec3& axis, double angle);  ///< `axis` of unit length
Track rotation_track(uint32_t node, double length_s, int keys, const std::vector<glm::dquat>& values);
Track translation_track(uint32_t node, double length_s, int keys, const std::vector<glm::dvec3>& values);

/// Puts the animation before the camera's path, so that it is the one that plays by default.
void add_motion(Scene& scene, const char* name, std::vector<Track> tracks, double length_s);

}  // namespace izb::procedural
