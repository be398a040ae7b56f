// SPDX-License-Identifier: MIT
#pragma once
#include <filesystem>

#include "scene/scene.h"

namespace izb {

/// Loads a glTF 2.0 file (.gltf or .glb), posed with its nodes at rest. Throws izb::Error with one sentence that names
/// the file and the cause; never returns a scene with an index out of range, a position that is not finite, or no
/// triangle. `stays`: it will not be posed otherwise, so that Scene::ignored names what stands still.
Scene load_gltf(const std::filesystem::path& path, bool stays = true);

}  // namespace izb
