// SPDX-License-Identifier: MIT
// From a file to tinygltf's model: the container, the JSON's checks, buffers and images.
#pragma once
#include <tiny_gltf.h>

#include <filesystem>
#include <functional>

namespace izb {

/// Reads and checks a .gltf or .glb file. In the model that returns, every index that the loader follows
/// names an existing object, every buffer view lies within its buffer, and no node transform has a wrong
/// number of elements. Images that a base colour uses are decoded to 8-bit RGBA; one that is absent or broken
/// is left empty with a warning on stderr. All other images are left empty. Throws izb::Error with the cause
/// alone (the caller knows the path). `read`, if any, is told the share of the file that is read.
tinygltf::Model read_gltf_document(const std::filesystem::path& path, const std::function<void(double share)>& read);

}  // namespace izb
