// SPDX-License-Identifier: MIT
// What deforms the primitives of a glTF file: morph targets and joint weights.
#pragma once
#include <tiny_gltf.h>

#include "scene/gltf_accessor.h"
#include "scene/scene.h"

namespace izb {

/// Fills `mesh.targets` from the primitive, for the vertices in the range. Throws izb::Error with the cause alone.
void load_morph_targets(const tinygltf::Model& model, const tinygltf::Primitive& primitive, const ElementRange& range,
                        Mesh& mesh);

/// Fills `mesh.joints` and `mesh.weights` from all sets JOINTS_n and WEIGHTS_n, weights of 0 left out and the rest with
/// the sum 1 (glTF 2.0, section 3.7.3.3); a vertex without any follows joint 0, so that it stays near the body.
void load_influences(const tinygltf::Model& model, const tinygltf::Primitive& primitive, const ElementRange& range,
                     Mesh& mesh);

}  // namespace izb
