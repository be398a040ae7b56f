// SPDX-License-Identifier: MIT
// The node hierarchy of a glTF file.
#pragma once
#include <tiny_gltf.h>

#include <vector>

#include "scene/scene.h"

namespace izb {

struct NodeHierarchy {
  std::vector<int> in_scene;     ///< the file's nodes that are shown, parents before children
  std::vector<int> scene_index;  ///< of each of the file's nodes: its entry in Scene::nodes
};

/// Appends all nodes of the file to the scene's, parents before children; one without a name is `node N`. A node that
/// shows a mesh gets the mesh's morph weights where it has none of its own. What is shown: the default scene, else the
/// first one, else (a file without scenes) all nodes. Throws izb::Error with the cause alone: cycles, a node with two
/// parents, a transform that is not finite or not affine.
NodeHierarchy load_nodes(const tinygltf::Model& model, Scene& scene);

}  // namespace izb
