// SPDX-License-Identifier: MIT
#pragma once
#include <tiny_gltf.h>

#include "scene/gltf_nodes.h"
#include "scene/scene.h"

namespace izb {

/// Appends the cameras of the nodes that are shown, not yet posed. A camera's name is its node's, else its own, else
/// `camera N`. One that cannot be used (no direction, no field of view) is left out and said in `scene.ignored`.
void load_cameras(const tinygltf::Model& model, const NodeHierarchy& nodes, Scene& scene);

/// The same for the lights of KHR_lights_punctual.
void load_lights(const tinygltf::Model& model, const NodeHierarchy& nodes, Scene& scene);

}  // namespace izb
