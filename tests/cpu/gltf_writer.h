// SPDX-License-Identifier: MIT
// Small glTF files for the tests, written to a folder that disappears with the test.
#pragma once
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

namespace izb::test {

using nlohmann::json;

class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "izb_gltf_XXXXXX").string();
    if (!mkdtemp(pattern.data())) throw std::runtime_error("cannot make a temporary folder");
    path_ = pattern;
  }
  ~TemporaryFolder() {
    std::error_code error;
    std::filesystem::remove_all(path_, error);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

inline std::filesystem::path write_file(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
  return path;
}

template <typename T>
std::string bytes_of(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

constexpr int type_int8 = 5120, type_uint8 = 5121, type_int16 = 5122, type_uint16 = 5123, type_uint32 = 5125,
              type_float = 5126;

/// A glTF document with one buffer. `root` may be changed freely before it is written.
class GltfWriter {
 public:
  GltfWriter() {
    root = {{"asset", {{"version", "2.0"}}},
            {"scene", 0},
            {"scenes", {{{"nodes", json::array()}}}},
            {"nodes", json::array()},
            {"meshes", json::array()},
            {"accessors", json::array()},
            {"bufferViews", json::array()}};
  }

  json root;
  std::string buffer;

  int add_view(const std::string& bytes, int stride = 0) {
    while (buffer.size() % 4 != 0) buffer += '\0';
    json view = {{"buffer", 0}, {"byteOffset", buffer.size()}, {"byteLength", bytes.size()}};
    if (stride > 0) view["byteStride"] = stride;
    buffer += bytes;
    return append("bufferViews", view);
  }

  int add_accessor(int view, int component_type, const char* type, size_t count) {
    return append("accessors",
                  {{"bufferView", view}, {"componentType", component_type}, {"type", type}, {"count", count}});
  }

  template <typename T>
  int add_array(const std::vector<T>& values, int component_type, const char* type, size_t components) {
    return add_accessor(add_view(bytes_of(values)), component_type, type, values.size() / components);
  }

  int add_positions(const std::vector<float>& xyz) { return add_array(xyz, type_float, "VEC3", 3); }

  /// A mesh of one primitive.
  int add_mesh(const json& primitive) { return append("meshes", {{"primitives", {primitive}}}); }

  /// A node at the root of scene 0.
  int add_root(const json& node) {
    const int index = append("nodes", node);
    root["scenes"][0]["nodes"].push_back(index);
    return index;
  }

  int append(const char* array, const json& object) {
    root[array].push_back(object);
    return static_cast<int>(root[array].size() - 1);
  }

  /// The document as a GLB, four bytes aligned.
  std::string glb() const {
    json document = root;
    if (!document.contains("buffers") && !buffer.empty()) document["buffers"] = {{{"byteLength", buffer.size()}}};
    std::string text = document.dump(), binary = buffer;
    text.resize((text.size() + 3) / 4 * 4, ' ');
    binary.resize((binary.size() + 3) / 4 * 4, '\0');
    const size_t total = 20 + text.size() + (binary.empty() ? 0 : 8 + binary.size());
    std::string bytes = "glTF" + u32(2) + u32(total) + u32(text.size()) + "JSON" + text;
    if (!binary.empty()) bytes += u32(binary.size()) + std::string("BIN\0", 4) + binary;
    return bytes;
  }

  static std::string u32(size_t value) {
    const auto v = static_cast<uint32_t>(value);
    return {static_cast<char>(v), static_cast<char>(v >> 8), static_cast<char>(v >> 16), static_cast<char>(v >> 24)};
  }
};

/// One triangle (0,0,0) (1,0,0) (0,1,0) with 16-bit indices, shown by one node.
/// Accessor 0 is its positions, accessor 1 its indices.
inline GltfWriter one_triangle() {
  GltfWriter gltf;
  const int positions = gltf.add_positions({0, 0, 0, 1, 0, 0, 0, 1, 0});
  const int indices = gltf.add_array(std::vector<uint16_t>{0, 1, 2}, type_uint16, "SCALAR", 1);
  gltf.add_root({{"mesh", gltf.add_mesh({{"attributes", {{"POSITION", positions}}}, {"indices", indices}})}});
  return gltf;
}

}  // namespace izb::test
