// SPDX-License-Identifier: MIT
#pragma once
#include <tiny_gltf.h>

#include <optional>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace izb {

/// What the meshes of a file hold that is not shown, or not as one may expect, counted while they load.
struct MeshTally {
  size_t point_primitives = 0, line_primitives = 0, without_positions = 0;
  size_t trailing_indices = 0;    ///< beyond the last whole triangle
  size_t bad_normals = 0;         ///< zero or not finite, replaced
  size_t colored_primitives = 0;  ///< with COLOR_0
  size_t skinned_primitives = 0, morphed_primitives = 0;

  /// One sentence for each thing that was counted, appended to `ignored`; `stays`: no animation poses the meshes.
  void describe(std::vector<std::string>& ignored, bool stays) const;
};

/// One primitive at rest as an indexed triangle list: strips and fans unrolled, with what morph targets and joints do
/// to it. Empty if it holds no triangle. Throws izb::Error with the cause alone: index out of range, position not
/// finite, attributes of different counts.
std::optional<Mesh> load_primitive(const tinygltf::Model& model, int mesh, int primitive, MeshTally& tally);

}  // namespace izb
