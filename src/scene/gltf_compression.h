// SPDX-License-Identifier: MIT
// Compressed geometry of glTF files: EXT_meshopt_compression (by meshoptimizer) and KHR_draco_mesh_compression (by
// Draco). A build without one of the libraries refuses by name the files that require it.
#pragma once
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

namespace tinygltf {
class Model;
}

namespace izb {

bool meshopt_available();
bool draco_available();

/// A buffer view whose bytes are compressed.
struct MeshoptView {
  size_t view = 0;
  uint64_t count = 0, stride = 0;  ///< of the elements that come out
  std::string mode, filter;
};

/// A primitive whose indices and attributes are compressed together.
struct DracoPrimitive {
  size_t mesh = 0, primitive = 0, view = 0;
  std::vector<std::pair<std::string, uint32_t>> attributes;  ///< name in the file, number in the stream
};

struct Compression {
  bool any() const { return !views.empty() || !primitives.empty(); }

  std::vector<MeshoptView> views;
  std::vector<DracoPrimitive> primitives;
};

/// What of a checked document is compressed in a way that this build reads. Of meshopt the views are pointed at their
/// compressed bytes, and buffers that only stand for what comes out are cut to one byte; of Draco indices get the
/// compressed view: so that a parser which does not know the extensions takes the file. Throws izb::Error with the
/// cause alone.
Compression take_compression(nlohmann::json& root);

/// Decompresses into buffers of their own. Throws izb::Error with the cause alone: streams that are broken, or claim
/// more than they can hold.
void decompress(tinygltf::Model& model, const Compression& compression);

}  // namespace izb
