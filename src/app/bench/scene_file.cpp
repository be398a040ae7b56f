// SPDX-License-Identifier: MIT
#include "app/bench/scene_file.h"

#include <cstring>
#include <nlohmann/json.hpp>
#include <span>
#include <vector>

#include "base/error.h"
#include "base/file.h"
#include "base/sha256.h"
#include "scene/gltf_uri.h"

namespace izb::bench {
namespace {

using nlohmann::json;

uint32_t word_at(std::span<const std::byte> bytes, size_t at) {
  uint32_t word = 0;
  for (size_t i = 0; i < 4; ++i) word |= std::to_integer<uint32_t>(bytes[at + i]) << (8 * i);
  return word;
}

/// The glTF's JSON: the first chunk of a GLB, or the whole file. Discarded where it is neither.
json root_of(std::span<const std::byte> bytes) {
  constexpr size_t header_bytes = 20;
  if (bytes.size() >= header_bytes && std::memcmp(bytes.data(), "glTF", 4) == 0) {
    const size_t length = word_at(bytes, 12);
    if (length > bytes.size() - header_bytes) return json(json::value_t::discarded);
    bytes = bytes.subspan(header_bytes, length);
  }
  const char* const text = reinterpret_cast<const char*>(bytes.data());
  return json::parse(text, text + bytes.size(), nullptr, false);
}

}  // namespace

SceneFile look_into(const std::filesystem::path& path) {
  const std::vector<std::byte> bytes = read_binary_file(path);
  SceneFile file{sha256_hex(bytes)};
  const json root = root_of(bytes);
  if (!root.is_object()) return file;
  const auto elements = [&](const char* key) {
    return root.contains(key) && root[key].is_array() ? root[key] : json();
  };
  file.animated = !elements("animations").empty();
  std::string all;
  for (const char* key : {"buffers", "images"})
    for (const json& element : elements(key)) {
      if (!element.is_object() || !element.contains("uri") || !element["uri"].is_string()) continue;
      const std::string uri = element["uri"];
      if (uri.starts_with("data:")) continue;
      std::string digest = "none";
      try {
        digest = sha256_hex(read_binary_file(path.parent_path() / percent_decoded(uri)));
      } catch (const Error&) {  // the loader says so, if it needs it
      }
      all += digest + " " + uri + "\n";
    }
  if (!all.empty()) all += file.sha256;
  if (!all.empty()) file.sha256 = sha256_hex(std::as_bytes(std::span(all)));
  return file;
}

}  // namespace izb::bench
