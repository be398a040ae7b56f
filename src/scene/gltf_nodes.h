// SPDX-License-Identifier: MIT
// The node hierarchy of a glTF file, flattened in double precision.
#pragma once
#include <tiny_gltf.h>

#include <glm/glm.hpp>
#include <vector>

namespace izb {

struct NodeHierarchy {
  std::vector<glm::dmat4> world_from_node;  ///< one a node of the file, also of those outside the scene
  std::vector<int> in_scene;                ///< the nodes that are shown, parents before children
};

/// Shows the default scene, else the first one, else (a file without scenes) all nodes.
/// Throws izb::Error with the cause alone: cycles, a node with two parents, a transform that is not finite or
/// not affine.
NodeHierarchy flatten_nodes(const tinygltf::Model& model);

}  // namespace izb
