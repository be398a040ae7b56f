// SPDX-License-Identifier: MIT
#include "scene/gltf_check.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/error.h"
#include "scene/gltf_compression.h"

namespace izb {
namespace {

using nlohmann::json;

enum class Kind { object, text, boolean, number, numbers, whole, small_whole, index };

/// What the values at a path must be. In a path, `[]` stands for every element and `{}` for every member.
struct Rule {
  std::string_view path;
  Kind kind;
  bool required = false;         ///< the path's last name must be there wherever its parent is
  size_t length = 0;             ///< numbers: how many
  std::string_view target = {};  ///< index: path of the array that it points into
};

constexpr std::string_view lights = "extensions.KHR_lights_punctual.lights";

// clang-format off
constexpr auto rules = std::to_array<Rule>({
    {"asset", Kind::object, true},
    {"asset.version", Kind::text, true},
    {"asset.minVersion", Kind::text},
    {"extensionsUsed[]", Kind::text},
    {"extensionsRequired[]", Kind::text},
    {"extensions", Kind::object},
    {"scene", Kind::index, false, 0, "scenes"},
    {"scenes[]", Kind::object},
    {"scenes[].name", Kind::text},
    {"scenes[].nodes[]", Kind::index, false, 0, "nodes"},
    {"nodes[]", Kind::object},
    {"nodes[].name", Kind::text},
    {"nodes[].mesh", Kind::index, false, 0, "meshes"},
    {"nodes[].camera", Kind::index, false, 0, "cameras"},
    {"nodes[].skin", Kind::index, false, 0, "skins"},
    {"nodes[].children[]", Kind::index, false, 0, "nodes"},
    {"nodes[].matrix", Kind::numbers, false, 16},
    {"nodes[].translation", Kind::numbers, false, 3},
    {"nodes[].rotation", Kind::numbers, false, 4},
    {"nodes[].scale", Kind::numbers, false, 3},
    {"nodes[].weights[]", Kind::number},
    {"nodes[].extensions.KHR_lights_punctual.light", Kind::index, true, 0, lights},
    {"meshes[]", Kind::object},
    {"meshes[].name", Kind::text},
    {"meshes[].weights[]", Kind::number},
    {"meshes[].primitives[]", Kind::object, true},
    {"meshes[].primitives[].attributes", Kind::object, true},
    {"meshes[].primitives[].attributes{}", Kind::index, false, 0, "accessors"},
    {"meshes[].primitives[].indices", Kind::index, false, 0, "accessors"},
    {"meshes[].primitives[].material", Kind::index, false, 0, "materials"},
    {"meshes[].primitives[].mode", Kind::small_whole},
    {"meshes[].primitives[].targets[]", Kind::object},
    {"meshes[].primitives[].targets[]{}", Kind::index, false, 0, "accessors"},
    {"meshes[].primitives[].extensions", Kind::object},
    {"meshes[].primitives[].extensions.KHR_draco_mesh_compression", Kind::object},
    {"meshes[].primitives[].extensions.KHR_draco_mesh_compression.bufferView", Kind::index, true, 0, "bufferViews"},
    {"meshes[].primitives[].extensions.KHR_draco_mesh_compression.attributes", Kind::object, true},
    {"meshes[].primitives[].extensions.KHR_draco_mesh_compression.attributes{}", Kind::small_whole},
    {"bufferViews[].extensions", Kind::object},
    {"bufferViews[].extensions.EXT_meshopt_compression", Kind::object},
    {"bufferViews[].extensions.EXT_meshopt_compression.buffer", Kind::index, true, 0, "buffers"},
    {"bufferViews[].extensions.EXT_meshopt_compression.byteOffset", Kind::whole},
    {"bufferViews[].extensions.EXT_meshopt_compression.byteLength", Kind::whole, true},
    {"bufferViews[].extensions.EXT_meshopt_compression.byteStride", Kind::small_whole, true},
    {"bufferViews[].extensions.EXT_meshopt_compression.count", Kind::whole, true},
    {"bufferViews[].extensions.EXT_meshopt_compression.mode", Kind::text, true},
    {"bufferViews[].extensions.EXT_meshopt_compression.filter", Kind::text},
    {"buffers[].extensions", Kind::object},
    {"buffers[].extensions.EXT_meshopt_compression", Kind::object},
    {"buffers[].extensions.EXT_meshopt_compression.fallback", Kind::boolean},
    {"accessors[]", Kind::object},
    {"accessors[].bufferView", Kind::index, false, 0, "bufferViews"},
    {"accessors[].byteOffset", Kind::whole},
    {"accessors[].componentType", Kind::small_whole, true},
    {"accessors[].normalized", Kind::boolean},
    {"accessors[].count", Kind::whole, true},
    {"accessors[].type", Kind::text, true},
    {"accessors[].min[]", Kind::number},
    {"accessors[].max[]", Kind::number},
    {"accessors[].sparse", Kind::object},
    {"accessors[].sparse.count", Kind::small_whole, true},
    {"accessors[].sparse.indices", Kind::object, true},
    {"accessors[].sparse.indices.bufferView", Kind::index, true, 0, "bufferViews"},
    {"accessors[].sparse.indices.byteOffset", Kind::small_whole},
    {"accessors[].sparse.indices.componentType", Kind::small_whole, true},
    {"accessors[].sparse.values", Kind::object, true},
    {"accessors[].sparse.values.bufferView", Kind::index, true, 0, "bufferViews"},
    {"accessors[].sparse.values.byteOffset", Kind::small_whole},
    {"bufferViews[]", Kind::object},
    {"bufferViews[].buffer", Kind::index, true, 0, "buffers"},
    {"bufferViews[].byteOffset", Kind::whole},
    {"bufferViews[].byteLength", Kind::whole, true},
    {"bufferViews[].byteStride", Kind::small_whole},
    {"buffers[]", Kind::object},
    {"buffers[].uri", Kind::text},
    {"buffers[].byteLength", Kind::whole, true},
    {"images[]", Kind::object},
    {"images[].name", Kind::text},
    {"images[].uri", Kind::text},
    {"images[].mimeType", Kind::text},
    {"images[].bufferView", Kind::index, false, 0, "bufferViews"},
    {"textures[]", Kind::object},
    {"textures[].source", Kind::index, false, 0, "images"},
    {"textures[].sampler", Kind::index, false, 0, "samplers"},
    {"samplers[]", Kind::object},
    {"samplers[].magFilter", Kind::small_whole},
    {"samplers[].minFilter", Kind::small_whole},
    {"samplers[].wrapS", Kind::small_whole},
    {"samplers[].wrapT", Kind::small_whole},
    {"materials[]", Kind::object},
    {"materials[].name", Kind::text},
    {"materials[].alphaMode", Kind::text},
    {"materials[].alphaCutoff", Kind::number},
    {"materials[].doubleSided", Kind::boolean},
    {"materials[].emissiveFactor", Kind::numbers, false, 3},
    {"materials[].pbrMetallicRoughness", Kind::object},
    {"materials[].pbrMetallicRoughness.baseColorFactor", Kind::numbers, false, 4},
    {"materials[].pbrMetallicRoughness.metallicFactor", Kind::number},
    {"materials[].pbrMetallicRoughness.roughnessFactor", Kind::number},
    {"materials[].pbrMetallicRoughness.baseColorTexture.index", Kind::index, true, 0, "textures"},
    {"materials[].pbrMetallicRoughness.baseColorTexture.texCoord", Kind::small_whole},
    {"materials[].pbrMetallicRoughness.baseColorTexture.extensions.KHR_texture_transform.offset", Kind::numbers, false, 2},
    {"materials[].pbrMetallicRoughness.baseColorTexture.extensions.KHR_texture_transform.rotation", Kind::number},
    {"materials[].pbrMetallicRoughness.baseColorTexture.extensions.KHR_texture_transform.scale", Kind::numbers, false, 2},
    {"materials[].pbrMetallicRoughness.baseColorTexture.extensions.KHR_texture_transform.texCoord", Kind::small_whole},
    {"materials[].pbrMetallicRoughness.metallicRoughnessTexture.index", Kind::index, true, 0, "textures"},
    {"materials[].normalTexture.index", Kind::index, true, 0, "textures"},
    {"materials[].normalTexture.scale", Kind::number},
    {"materials[].occlusionTexture.index", Kind::index, true, 0, "textures"},
    {"materials[].occlusionTexture.strength", Kind::number},
    {"materials[].emissiveTexture.index", Kind::index, true, 0, "textures"},
    {"cameras[]", Kind::object},
    {"cameras[].name", Kind::text},
    {"cameras[].type", Kind::text, true},
    {"cameras[].perspective.yfov", Kind::number, true},
    {"cameras[].perspective.znear", Kind::number, true},
    {"cameras[].perspective.zfar", Kind::number},
    {"cameras[].perspective.aspectRatio", Kind::number},
    {"cameras[].orthographic.xmag", Kind::number, true},
    {"cameras[].orthographic.ymag", Kind::number, true},
    {"cameras[].orthographic.znear", Kind::number, true},
    {"cameras[].orthographic.zfar", Kind::number, true},
    {"skins[]", Kind::object},
    {"skins[].joints[]", Kind::index, true, 0, "nodes"},
    {"skins[].inverseBindMatrices", Kind::index, false, 0, "accessors"},
    {"skins[].skeleton", Kind::index, false, 0, "nodes"},
    {"animations[]", Kind::object},
    {"animations[].name", Kind::text},
    {"animations[].channels[]", Kind::object, true},
    {"animations[].channels[].sampler", Kind::small_whole, true},
    {"animations[].channels[].target", Kind::object, true},
    {"animations[].channels[].target.node", Kind::index, false, 0, "nodes"},
    {"animations[].channels[].target.path", Kind::text, true},
    {"animations[].samplers[]", Kind::object, true},
    {"animations[].samplers[].input", Kind::index, true, 0, "accessors"},
    {"animations[].samplers[].output", Kind::index, true, 0, "accessors"},
    {"animations[].samplers[].interpolation", Kind::text},
    {"extensions.KHR_lights_punctual.lights[]", Kind::object, true},
    {"extensions.KHR_lights_punctual.lights[].name", Kind::text},
    {"extensions.KHR_lights_punctual.lights[].type", Kind::text, true},
    {"extensions.KHR_lights_punctual.lights[].color", Kind::numbers, false, 3},
    {"extensions.KHR_lights_punctual.lights[].intensity", Kind::number},
    {"extensions.KHR_lights_punctual.lights[].range", Kind::number},
    {"extensions.KHR_lights_punctual.lights[].spot.innerConeAngle", Kind::number},
    {"extensions.KHR_lights_punctual.lights[].spot.outerConeAngle", Kind::number},
});
// clang-format on

constexpr auto supported_extensions =
    std::to_array<std::string_view>({"KHR_lights_punctual", "KHR_mesh_quantization", "KHR_texture_transform"});

/// Walks one rule through the document; the way there is kept for the message only.
class RuleWalk {
 public:
  RuleWalk(const json& root, const Rule& rule) : root_(root), rule_(rule) {
    if (rule.kind == Kind::index) target_count_ = array_length(rule.target);
  }

  void run() { visit(root_, rule_.path); }

 private:
  using Crumb = std::variant<std::string_view, size_t>;

  size_t array_length(const std::string_view target) const {
    const json* value = &root_;
    std::string_view path = target;
    while (!path.empty()) {
      const size_t dot = std::min(path.find('.'), path.size());
      if (!value->is_object()) return 0;
      const auto it = value->find(std::string(path.substr(0, dot)));
      if (it == value->end()) return 0;
      value = &*it;
      path.remove_prefix(std::min(dot + 1, path.size()));
    }
    if (!value->is_array()) fail("{} is not an array", target);
    return value->size();
  }

  std::string where() const {
    std::string text;
    for (const Crumb& crumb : crumbs_) {
      if (const auto* name = std::get_if<std::string_view>(&crumb)) {
        if (!text.empty()) text += '.';
        text += *name;
      } else {
        text += fmt::format("[{}]", std::get<size_t>(crumb));
      }
    }
    return text.empty() ? "its JSON" : text;
  }

  void visit(const json& value, std::string_view rest) {
    if (rest.empty()) return check(value);
    if (rest.starts_with("[]")) {
      if (!value.is_array()) fail("{} is not an array", where());
      for (size_t i = 0; i < value.size(); ++i) {
        crumbs_.emplace_back(i);
        visit(value[i], rest.substr(2));
        crumbs_.pop_back();
      }
      return;
    }
    if (!value.is_object()) fail("{} is not an object", where());
    if (rest.starts_with("{}")) {
      for (auto it = value.begin(); it != value.end(); ++it) {
        crumbs_.emplace_back(std::string_view(it.key()));
        visit(it.value(), rest.substr(2));
        crumbs_.pop_back();
      }
      return;
    }
    if (rest.front() == '.') rest.remove_prefix(1);
    const std::string_view name = rest.substr(0, rest.find_first_of(".[{"));
    rest.remove_prefix(name.size());
    const auto it = value.find(name);
    if (it == value.end()) {
      const bool is_last_name = rest.find('.') == std::string_view::npos;
      if (rule_.required && is_last_name) fail("{} has no '{}'", where(), name);
      return;
    }
    crumbs_.emplace_back(name);
    visit(*it, rest);
    crumbs_.pop_back();
  }

  void require(bool condition, std::string_view what) const {
    if (!condition) fail("{} is not {}", where(), what);
  }

  void check(const json& value) const {
    constexpr uint64_t largest_whole = uint64_t(1) << 53;
    constexpr uint64_t largest_small = 0x7fffffff;
    switch (rule_.kind) {
      case Kind::object:
        return require(value.is_object(), "an object");
      case Kind::text:
        return require(value.is_string(), "a string");
      case Kind::boolean:
        return require(value.is_boolean(), "true or false");
      case Kind::number:
        return require(value.is_number(), "a number");
      case Kind::whole:
        return require(value.is_number_unsigned() && value.get<uint64_t>() <= largest_whole,
                       "a whole number of at most 2^53");
      case Kind::small_whole:
        return require(value.is_number_unsigned() && value.get<uint64_t>() <= largest_small,
                       "a whole number below 2^31");
      case Kind::numbers: {
        const bool ok = value.is_array() && value.size() == rule_.length &&
                        std::all_of(value.begin(), value.end(), [](const json& v) { return v.is_number(); });
        return require(ok, fmt::format("an array of {} numbers", rule_.length));
      }
      case Kind::index:
        require(value.is_number_unsigned(), "an index (a whole number)");
        if (value.get<uint64_t>() >= target_count_) {
          const std::string_view plural = rule_.target.substr(rule_.target.rfind('.') + 1);
          fail("{} is {}, but the file's number of {} is {}", where(), value.get<uint64_t>(), plural, target_count_);
        }
    }
  }

  const json& root_;
  const Rule& rule_;
  size_t target_count_ = 0;
  std::vector<Crumb> crumbs_;
};

void check_version(const json& root) {
  if (!root.is_object() || !root.contains("asset") || !root["asset"].is_object() ||
      !root["asset"].contains("version") || !root["asset"]["version"].is_string())
    fail("its JSON is not glTF (there is no asset.version)");
  const auto version = root["asset"]["version"].get<std::string>();
  if (!version.starts_with("2.")) fail("it is glTF version '{}', and only version 2 is read", version);
  const json& min_version = root["asset"].value("minVersion", json("2.0"));
  if (min_version.is_string() && min_version != "2.0")
    fail("it needs glTF version '{}', and only 2.0 is read", min_version.get<std::string>());
}

void check_required_extensions(const json& root) {
  const auto it = root.find("extensionsRequired");
  if (it == root.end() || !it->is_array()) return;
  for (const json& name : *it)
    if (name.is_string() && !gltf_extension_is_supported(name.get_ref<const std::string&>()))
      fail("it requires the extension {}, which is not supported", name.get<std::string>());
}

void check_buffer_views(const json& root) {
  const auto views = root.find("bufferViews");
  if (views == root.end()) return;
  for (size_t i = 0; i < views->size(); ++i) {
    const json& view = (*views)[i];
    const uint64_t buffer = view["buffer"], length = view["byteLength"];
    const uint64_t offset = view.value("byteOffset", uint64_t(0));
    const uint64_t available = root["buffers"][buffer]["byteLength"];
    if (length == 0) fail("bufferViews[{}].byteLength is 0", i);
    if (offset > available || length > available - offset)
      fail("bufferViews[{}] ends at byte {}, but buffers[{}] has {} bytes", i, offset + length, buffer, available);
  }
}

void check_accessor_types(const json& root) {
  const auto accessors = root.find("accessors");
  if (accessors == root.end()) return;
  constexpr auto component_types = std::to_array<int64_t>({5120, 5121, 5122, 5123, 5125, 5126});
  constexpr auto types = std::to_array<std::string_view>({"SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"});
  const auto check_component = [&](const json& type, size_t i) {
    if (std::find(component_types.begin(), component_types.end(), type.get<int64_t>()) == component_types.end())
      fail("accessors[{}] has the unknown component type {}", i, type.get<int64_t>());
  };
  for (size_t i = 0; i < accessors->size(); ++i) {
    const json& accessor = (*accessors)[i];
    const auto type = accessor["type"].get<std::string>();
    if (std::find(types.begin(), types.end(), type) == types.end())
      fail("accessors[{}] has the unknown type '{}'", i, type);
    check_component(accessor["componentType"], i);
    if (accessor.contains("sparse")) check_component(accessor["sparse"]["indices"]["componentType"], i);
  }
}

}  // namespace

bool gltf_extension_is_supported(std::string_view name) {
  if (name == "EXT_meshopt_compression") return meshopt_available();
  if (name == "KHR_draco_mesh_compression") return draco_available();
  return std::find(supported_extensions.begin(), supported_extensions.end(), name) != supported_extensions.end();
}

void check_gltf_json(const json& root) {
  check_version(root);
  check_required_extensions(root);
  for (const Rule& rule : rules) RuleWalk(root, rule).run();
  check_buffer_views(root);
  check_accessor_types(root);
}

}  // namespace izb
