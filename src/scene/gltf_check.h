// SPDX-License-Identifier: MIT
// The glTF file's JSON, checked before tinygltf sees it: tinygltf ignores wrong types and indices, or reads
// past its buffers because of them.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string_view>

namespace izb {

/// Checks version, required extensions, the type of every property that the loader reads, that every index
/// names an existing object, and that every buffer view lies within its buffer's declared length. Throws
/// izb::Error with the cause alone, e.g. "nodes[3].mesh is 7, but there are only 2 meshes".
void check_gltf_json(const nlohmann::json& root);

/// Whether the loader gives the extension its full meaning, so that a file may require it.
bool gltf_extension_is_supported(std::string_view name);

}  // namespace izb
