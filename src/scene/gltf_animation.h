// SPDX-License-Identifier: MIT
// glTF animations (glTF 2.0, section 3.11), evaluated in double precision.
#pragma once
#include <vector>

#include "scene/gltf.h"

namespace tinygltf {
class Model;
}

namespace izb {

/// Name and length of each animation of a file.
std::vector<Animation> describe_animations(const tinygltf::Model& model);

/// Gives the nodes the translations, rotations, scales and morph weights that they have at that moment: a time before
/// the first key is that key's, one after the last is the last's. Throws izb::Error with the cause alone: an animation
/// that the file does not have, keys without order, values that do not fit, a node with a matrix.
void pose_nodes(tinygltf::Model& model, const AnimationMoment& moment);

}  // namespace izb
