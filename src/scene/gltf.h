// SPDX-License-Identifier: MIT
#pragma once
#include <filesystem>
#include <optional>

#include "scene/pose.h"

namespace izb {

/// Loads a glTF 2.0 file (.gltf or .glb), posed as it is at that moment; without one skinned and morphed meshes stand
/// in bind pose. Throws izb::Error with one sentence that names the file and the cause; never returns a scene with an
/// index out of range, a position that is not finite, or no triangle.
Scene load_gltf(const std::filesystem::path& path, const std::optional<AnimationMoment>& moment = {});

}  // namespace izb
