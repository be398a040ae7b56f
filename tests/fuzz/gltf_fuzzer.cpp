// SPDX-License-Identifier: MIT
// libFuzzer on the glTF loader: whatever a file holds, a scene comes out or izb::Error. A GLB is changed by its parts,
// its JSON as JSON, since hardly a byte flipped at random leaves a document that gets past the parser.
#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <nlohmann/json.hpp>
#include <optional>
#include <random>
#include <string>

#include "base/error.h"
#include "scene/gltf.h"

extern "C" size_t LLVMFuzzerMutate(uint8_t* data, size_t size, size_t max_size);

namespace {

using nlohmann::json;

struct Glb {
  json root;
  std::string binary;
};

uint32_t u32_at(const uint8_t* p) {
  uint32_t value;
  std::memcpy(&value, p, sizeof value);
  return value;
}

std::optional<Glb> parse(const uint8_t* data, size_t size) {
  if (size < 20 || std::memcmp(data, "glTF", 4) != 0 || std::memcmp(data + 16, "JSON", 4) != 0) return {};
  const size_t json_size = u32_at(data + 12);
  if (json_size > size - 20) return {};
  Glb glb{json::parse(data + 20, data + 20 + json_size, nullptr, false), {}};
  if (glb.root.is_discarded()) return {};
  const size_t binary_begin = 20 + json_size + 8;
  if (binary_begin < size) glb.binary.assign(data + binary_begin, data + size);
  return glb;
}

std::string written(const Glb& glb) {
  std::string text = glb.root.dump(-1, ' ', false, json::error_handler_t::replace), binary = glb.binary;
  text.resize((text.size() + 3) / 4 * 4, ' ');
  binary.resize((binary.size() + 3) / 4 * 4, '\0');
  const auto u32 = [](size_t value) {
    const auto v = static_cast<uint32_t>(value);
    return std::string(reinterpret_cast<const char*>(&v), sizeof v);
  };
  const size_t total = 20 + text.size() + (binary.empty() ? 0 : 8 + binary.size());
  std::string bytes = "glTF" + u32(2) + u32(total) + u32(text.size()) + "JSON" + text;
  if (!binary.empty()) bytes += u32(binary.size()) + std::string("BIN\0", 4) + binary;
  return bytes;
}

class Mutator {
 public:
  explicit Mutator(unsigned seed) : random_(seed) {}

  size_t below(size_t n) { return n == 0 ? 0 : random_() % n; }

  void change(json& root) {
    json& node = pick(root);
    switch (below(4)) {
      case 0:
        node = pick(root);  // what stands elsewhere in the document
        break;
      case 1:
        node = value();
        break;
      default:
        alter(node);
    }
  }

 private:
  json& pick(json& root) {
    json* chosen = &root;
    size_t seen = 0;
    visit(root, chosen, seen);
    return *chosen;
  }

  void visit(json& node, json*& chosen, size_t& seen) {
    if (below(++seen) == 0) chosen = &node;
    if (node.is_structured())
      for (json& child : node) visit(child, chosen, seen);
  }

  json value() {
    static const json values[] = {0,
                                  1,
                                  -1,
                                  2,
                                  3,
                                  4,
                                  5,
                                  12,
                                  16,
                                  255,
                                  256,
                                  65535,
                                  65536,
                                  5120,
                                  5121,
                                  5122,
                                  5123,
                                  5125,
                                  5126,
                                  2147483647,
                                  4294967296,
                                  9007199254740992,
                                  1e308,
                                  -1e308,
                                  1e-320,
                                  0.5,
                                  true,
                                  false,
                                  nullptr,
                                  "",
                                  "SCALAR",
                                  "VEC2",
                                  "VEC3",
                                  "VEC4",
                                  "MAT4",
                                  "MASK",
                                  "BLEND",
                                  "POSITION",
                                  "NORMAL",
                                  "TEXCOORD_0",
                                  "JOINTS_0",
                                  "WEIGHTS_0",
                                  "perspective",
                                  "point",
                                  "spot",
                                  "ATTRIBUTES",
                                  "TRIANGLES",
                                  "INDICES",
                                  "OCTAHEDRAL",
                                  "EXPONENTIAL",
                                  "QUATERNION",
                                  "data:application/octet-stream;base64,AAAAAAAA",
                                  "data:image/png;base64,iVBORw0KGgo=",
                                  json::array(),
                                  json::object()};
    return values[below(std::size(values))];
  }

  void alter(json& node) {
    if (node.is_number_integer()) {
      node = node.get<int64_t>() + static_cast<int64_t>(below(5)) - 2;
    } else if (node.is_number_float()) {
      node = node.get<double>() * (below(2) ? -1.0 : 1e3);
    } else if (node.is_array() && !node.empty()) {
      const size_t at = below(node.size());
      if (below(2))
        node.erase(at);
      else
        node.push_back(json(node[at]));
    } else if (node.is_object() && !node.empty()) {
      auto it = node.begin();
      std::advance(it, static_cast<std::ptrdiff_t>(below(node.size())));
      if (below(2))
        node.erase(it);
      else
        node[key()] = json(*it);
    } else {
      node = value();
    }
  }

  std::string key() {
    static const char* const keys[] = {"sparse",
                                       "byteStride",
                                       "byteOffset",
                                       "normalized",
                                       "extensions",
                                       "KHR_draco_mesh_compression",
                                       "EXT_meshopt_compression",
                                       "KHR_lights_punctual",
                                       "KHR_texture_transform",
                                       "indices",
                                       "targets",
                                       "weights",
                                       "skin",
                                       "joints",
                                       "inverseBindMatrices",
                                       "matrix",
                                       "rotation",
                                       "scale",
                                       "translation",
                                       "children",
                                       "camera",
                                       "mode",
                                       "uri",
                                       "bufferView",
                                       "material",
                                       "POSITION",
                                       "NORMAL",
                                       "TEXCOORD_0",
                                       "JOINTS_0",
                                       "WEIGHTS_0",
                                       "images",
                                       "textures"};
    return keys[below(std::size(keys))];
  }

  std::minstd_rand random_;
};

}  // namespace

extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t max_size, unsigned seed) {
  Mutator mutator(seed);
  std::optional<Glb> glb = parse(data, size);
  const size_t way = mutator.below(8);
  if (!glb || way == 0) return LLVMFuzzerMutate(data, size, max_size);
  if (way < 3 && !glb->binary.empty()) {
    std::string& binary = glb->binary;
    const size_t before = binary.size();
    binary.resize(before + 64);
    binary.resize(LLVMFuzzerMutate(reinterpret_cast<uint8_t*>(binary.data()), before, binary.size()));
  } else {
    for (size_t i = 0; i <= mutator.below(3); ++i) mutator.change(glb->root);
  }
  const std::string bytes = written(*glb);
  if (bytes.size() > max_size) return LLVMFuzzerMutate(data, size, max_size);
  std::memcpy(data, bytes.data(), bytes.size());
  return bytes.size();
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static const int file = memfd_create("fuzzed.glb", 0);
  static const std::string path = "/proc/self/fd/" + std::to_string(file);
  if (file < 0 || ftruncate(file, 0) != 0 || pwrite(file, data, size, 0) != static_cast<ssize_t>(size)) std::abort();
  try {
    const izb::Scene scene = izb::load_gltf(path);
    // What the rest of the program takes for granted.
    for (const izb::Mesh& mesh : scene.meshes) {
      if (mesh.material >= scene.materials.size() || mesh.indices.size() % 3 != 0) std::abort();
      if (!mesh.normals.empty() && mesh.normals.size() != mesh.positions.size()) std::abort();
      if (!mesh.uvs.empty() && mesh.uvs.size() != mesh.positions.size()) std::abort();
      for (const uint32_t index : mesh.indices)
        if (index >= mesh.positions.size()) std::abort();
    }
    for (const izb::Instance& instance : scene.instances)
      if (instance.mesh >= scene.meshes.size()) std::abort();
  } catch (const izb::Error&) {
  }
  return 0;
}
