// SPDX-License-Identifier: MIT
// The key frames of a glTF file (glTF 2.0, section 3.11).
#pragma once
#include <tiny_gltf.h>

#include "scene/gltf_nodes.h"

namespace izb {

/// Appends the file's animations. One that cannot be played has a fault in place of its tracks: keys without order,
/// values that do not fit, a node with a matrix.
void load_animations(const tinygltf::Model& model, const NodeHierarchy& nodes, Scene& scene);

}  // namespace izb
