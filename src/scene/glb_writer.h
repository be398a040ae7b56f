// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <filesystem>
#include <vector>

#include "scene/scene.h"

namespace izb {

/// The scene as a binary glTF 2.0 file with KHR_lights_punctual: one node an instance, sharing meshes;
/// matrices keep all bits of their doubles. The same scene always gives the same bytes. An orthographic
/// camera's width is written for 16:9, since the scene states its height only. Throws izb::Error for what it
/// does not write: textures, and meshes without a triangle.
std::vector<uint8_t> to_glb(const Scene& scene);

/// Writes to_glb(scene) to `path` under a temporary name beside it, then renames it, so that no partial file
/// is left. Throws izb::Error naming the path and the cause.
void write_glb(const Scene& scene, const std::filesystem::path& path);

}  // namespace izb
