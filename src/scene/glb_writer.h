// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <filesystem>
#include <vector>

#include "scene/scene.h"

namespace izb {

/// The scene as a binary glTF 2.0 file with KHR_lights_punctual: one node an instance, sharing meshes, but those that a
/// node of the scene places; with its skins, morph targets and animations, at rest. Matrices keep all bits of their
/// doubles. The same scene always gives the same bytes. An orthographic
/// camera's width is written for 16:9, since the scene states its height only. Throws izb::Error for what it
/// does not write: textures, meshes without a triangle, and morph weights that several meshes of one node share.
std::vector<uint8_t> to_glb(const Scene& scene);

/// Writes to_glb(scene) to `path` under a temporary name beside it, then renames it, so that no partial file
/// is left. Throws izb::Error naming the path and the cause.
void write_glb(const Scene& scene, const std::filesystem::path& path);

}  // namespace izb
