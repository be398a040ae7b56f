// SPDX-License-Identifier: MIT
// Typed copies of glTF accessors: any component type, normalised, interleaved and sparse (glTF 2.0,
// section 3.6.2). All functions throw izb::Error with the cause alone.
#pragma once
#include <tiny_gltf.h>

#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <vector>

namespace izb {

/// Some of an accessor's elements, by default all.
struct ElementRange {
  size_t first = 0, count = std::numeric_limits<size_t>::max();
};

/// Number of elements.
size_t accessor_count(const tinygltf::Model& model, int accessor);

/// Floats, or integers converted as the accessor's `normalized` says. The accessor's type must match.
std::vector<float> read_floats(const tinygltf::Model& model, int accessor);
std::vector<glm::vec2> read_vec2(const tinygltf::Model& model, int accessor, const ElementRange& range = {});
std::vector<glm::vec3> read_vec3(const tinygltf::Model& model, int accessor, const ElementRange& range = {});
std::vector<glm::vec4> read_vec4(const tinygltf::Model& model, int accessor, const ElementRange& range = {});
/// Column-major, as glTF stores them; float components only.
std::vector<glm::mat4> read_mat4(const tinygltf::Model& model, int accessor);

/// Unsigned integers of 8, 16 or 32 bits.
std::vector<uint32_t> read_indices(const tinygltf::Model& model, int accessor);
std::vector<glm::uvec4> read_uvec4(const tinygltf::Model& model, int accessor, const ElementRange& range = {});

}  // namespace izb
