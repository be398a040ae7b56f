// SPDX-License-Identifier: MIT
#pragma once
#include <filesystem>
#include <functional>

#include "scene/scene.h"

namespace izb {

using LoadProgress = std::function<void(double share)>;

/// Loads a glTF 2.0 file (.gltf or .glb), posed with its nodes at rest. Throws izb::Error with one sentence that names
/// the file and the cause; never returns a scene with an index out of range, a position that is not finite, or no
/// triangle. `stays`: it will not be posed otherwise, so that Scene::ignored names what stands still. `progress`, if
/// any, is told the share that is done, from 0 to 1 and never less than before.
Scene load_gltf(const std::filesystem::path& path, bool stays = true, const LoadProgress& progress = {});

}  // namespace izb
