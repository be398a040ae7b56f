// SPDX-License-Identifier: MIT
#pragma once
#include <tiny_gltf.h>

#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace izb {

/// What the meshes of a file hold that a Mesh does not, counted while they load.
struct MeshTally {
  size_t point_primitives = 0, line_primitives = 0, without_positions = 0;
  size_t trailing_indices = 0;    ///< beyond the last whole triangle
  size_t bad_normals = 0;         ///< zero or not finite, replaced
  size_t colored_primitives = 0;  ///< with COLOR_0
  size_t skinned_primitives = 0, morphed_primitives = 0;

  /// One sentence for each thing that was counted, appended to `ignored`; `at_rest`: no animation poses the meshes.
  void describe(std::vector<std::string>& ignored, bool at_rest) const;
};

/// Where a primitive stands in the file, and how it is posed.
struct PrimitiveSource {
  int mesh = 0, primitive = 0;
  std::span<const double> morph_weights;               ///< of the node or the mesh; may be shorter than the targets
  std::span<const glm::dmat4> world_from_bind_joints;  ///< one a joint of the skin; empty: not skinned
};

/// One primitive as an indexed triangle list: strips and fans unrolled, morph targets and (with joints) the
/// skin applied, so that a skinned one comes out in world space. Empty if it holds no triangle. Throws
/// izb::Error with the cause alone: index out of range, position not finite, attributes of different counts.
std::optional<Mesh> load_primitive(const tinygltf::Model& model, const PrimitiveSource& source, MeshTally& tally);

}  // namespace izb
