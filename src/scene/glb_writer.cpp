// SPDX-License-Identifier: MIT
#include "scene/glb_writer.h"

#include <bit>
#include <cmath>
#include <nlohmann/json.hpp>
#include <span>
#include <string>

#include "base/error.h"
#include "base/file.h"
#include "base/json_text.h"

namespace izb {
namespace {

static_assert(std::endian::native == std::endian::little, "glTF buffers are little-endian");

using Json = nlohmann::ordered_json;

// Numbers of the glTF 2.0 specification.
constexpr int component_float = 5126, component_uint = 5125, target_vertices = 34962, target_indices = 34963;
constexpr uint32_t glb_magic = 0x46546C67, chunk_json = 0x4E4F534A, chunk_binary = 0x004E4942;

struct Document {
  Json json;
  std::vector<uint8_t> binary;
};

template <typename T>
void append_bytes(std::vector<uint8_t>& bytes, std::span<const T> values) {
  const auto* data = reinterpret_cast<const uint8_t*>(values.data());
  bytes.insert(bytes.end(), data, data + values.size_bytes());
}

template <typename Vector>
Json numbers(const Vector& v) {
  Json array = Json::array();
  for (int i = 0; i < v.length(); ++i) array.push_back(v[i]);
  return array;
}

Json matrix(const glm::dmat4& m) {
  Json array = Json::array();
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) array.push_back(m[column][row]);
  }
  return array;
}

/// Appends the values to the binary chunk and returns the index of their accessor.
template <typename T>
size_t add_accessor(Document& doc, std::span<const T> values, const char* type, int component, int target) {
  const size_t offset = doc.binary.size();
  append_bytes(doc.binary, values);
  doc.json["bufferViews"].push_back(
      {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", values.size_bytes()}, {"target", target}});
  doc.json["accessors"].push_back({{"bufferView", doc.json["bufferViews"].size() - 1},
                                   {"componentType", component},
                                   {"count", values.size()},
                                   {"type", type}});
  return doc.json["accessors"].size() - 1;
}

Json material_json(const Material& material) {
  Json out{{"name", material.name}};
  if (material.alpha_mode == AlphaMode::mask) out["alphaMode"] = "MASK", out["alphaCutoff"] = material.alpha_cutoff;
  if (material.alpha_mode == AlphaMode::blend) out["alphaMode"] = "BLEND";
  if (material.double_sided) out["doubleSided"] = true;
  out["pbrMetallicRoughness"] = {{"baseColorFactor", numbers(material.base_color)},
                                 {"metallicFactor", material.metallic},
                                 {"roughnessFactor", material.roughness}};
  return out;
}

Json mesh_json(Document& doc, const Mesh& mesh) {
  if (mesh.indices.empty()) fail("mesh \"{}\" has no triangle, and glTF has no empty mesh", mesh.name);
  Json attributes;
  const size_t position =
      add_accessor(doc, std::span<const glm::vec3>{mesh.positions}, "VEC3", component_float, target_vertices);
  glm::vec3 low = mesh.positions.front(), high = low;
  for (const glm::vec3& p : mesh.positions) low = glm::min(low, p), high = glm::max(high, p);
  doc.json["accessors"][position]["min"] = numbers(low);
  doc.json["accessors"][position]["max"] = numbers(high);
  attributes["POSITION"] = position;
  if (!mesh.normals.empty()) {
    attributes["NORMAL"] =
        add_accessor(doc, std::span<const glm::vec3>{mesh.normals}, "VEC3", component_float, target_vertices);
  }
  if (!mesh.uvs.empty()) {
    attributes["TEXCOORD_0"] =
        add_accessor(doc, std::span<const glm::vec2>{mesh.uvs}, "VEC2", component_float, target_vertices);
  }
  const size_t indices =
      add_accessor(doc, std::span<const uint32_t>{mesh.indices}, "SCALAR", component_uint, target_indices);
  return {
      {"name", mesh.name},
      {"primitives", Json::array({{{"attributes", attributes}, {"indices", indices}, {"material", mesh.material}}})}};
}

Json camera_json(const Camera& camera) {
  Json out{{"name", camera.name}};
  Json lens;
  if (camera.orthographic) {
    if (!std::isfinite(camera.far_plane))
      fail("orthographic camera \"{}\" has no far plane, which glTF requires", camera.name);
    lens = {{"xmag", camera.ymag * 16.0 / 9.0}, {"ymag", camera.ymag}};
  } else {
    lens = {{"yfov", camera.yfov_rad}};
  }
  lens["znear"] = camera.near_plane;
  if (std::isfinite(camera.far_plane)) lens["zfar"] = camera.far_plane;
  const char* type = camera.orthographic ? "orthographic" : "perspective";
  out["type"] = type;
  out[type] = lens;
  return out;
}

Json light_json(const Light& light) {
  Json out{{"name", light.name}, {"color", numbers(light.color)}, {"intensity", light.intensity}};
  if (light.range > 0.0) out["range"] = light.range;
  switch (light.type) {
    case LightType::directional:
      out["type"] = "directional";
      break;
    case LightType::point:
      out["type"] = "point";
      break;
    case LightType::spot:
      out["type"] = "spot";
      out["spot"] = {{"innerConeAngle", light.inner_cone_rad}, {"outerConeAngle", light.outer_cone_rad}};
      break;
  }
  return out;
}

/// A placement whose -z axis is the light's direction, as KHR_lights_punctual has it.
glm::dmat4 world_from_light(const Light& light) {
  const glm::dvec3 z = -light.direction_ws;
  const glm::dvec3 axis = std::abs(z.y) < 0.9 ? glm::dvec3{0, 1, 0} : glm::dvec3{1, 0, 0};
  const glm::dvec3 x = glm::normalize(glm::cross(axis, z));
  const glm::dvec3 y = glm::cross(z, x);
  return {glm::dvec4{x, 0}, glm::dvec4{y, 0}, glm::dvec4{z, 0}, glm::dvec4{light.position_ws, 1}};
}

Json nodes_json(const Scene& scene) {
  Json nodes = Json::array();
  for (const Instance& instance : scene.instances) {
    Json node{{"name", scene.meshes[instance.mesh].name}, {"mesh", instance.mesh}};
    if (instance.world_from_object != glm::dmat4{1.0}) node["matrix"] = matrix(instance.world_from_object);
    nodes.push_back(node);
  }
  for (size_t i = 0; i < scene.cameras.size(); ++i) {
    const Camera& camera = scene.cameras[i];
    nodes.push_back({{"name", camera.name}, {"camera", i}, {"matrix", matrix(camera.world_from_view)}});
  }
  for (size_t i = 0; i < scene.lights.size(); ++i) {
    const Light& light = scene.lights[i];
    nodes.push_back({{"name", light.name},
                     {"matrix", matrix(world_from_light(light))},
                     {"extensions", {{"KHR_lights_punctual", {{"light", i}}}}}});
  }
  return nodes;
}

Document make_document(const Scene& scene) {
  if (!scene.textures.empty()) {
    fail("scene \"{}\" has textures, which the GLB writer does not write", scene.name);
  }
  Document doc;
  doc.json["asset"] = {{"version", "2.0"}, {"generator", "izb"}};
  doc.json["scene"] = 0;
  Json nodes = nodes_json(scene);
  Json roots = Json::array();
  for (size_t i = 0; i < nodes.size(); ++i) roots.push_back(i);
  doc.json["scenes"] = Json::array({{{"name", scene.name}, {"nodes", roots}}});
  doc.json["nodes"] = std::move(nodes);
  for (const Material& material : scene.materials) doc.json["materials"].push_back(material_json(material));
  for (const Camera& camera : scene.cameras) doc.json["cameras"].push_back(camera_json(camera));
  for (const Mesh& mesh : scene.meshes) {
    Json entry = mesh_json(doc, mesh);
    doc.json["meshes"].push_back(std::move(entry));
  }
  if (!scene.lights.empty()) {
    doc.json["extensionsUsed"] = {"KHR_lights_punctual"};
    Json& lights = doc.json["extensions"]["KHR_lights_punctual"]["lights"];
    for (const Light& light : scene.lights) lights.push_back(light_json(light));
  }
  doc.json["buffers"] = Json::array({{{"byteLength", doc.binary.size()}}});
  return doc;
}

}  // namespace

std::vector<uint8_t> to_glb(const Scene& scene) {
  const Document doc = make_document(scene);
  std::string text = json_text(doc.json);
  text.resize((text.size() + 3) / 4 * 4, ' ');  // chunks are padded to 4 bytes; every accessor is already
  const auto json_size = static_cast<uint32_t>(text.size());
  const size_t total = 12 + 8 + text.size() + 8 + doc.binary.size();
  if (total > UINT32_MAX) fail("scene \"{}\" needs {} bytes, more than a GLB file can hold", scene.name, total);

  std::vector<uint8_t> bytes;
  bytes.reserve(total);
  const uint32_t head[]{glb_magic, 2, static_cast<uint32_t>(total), json_size, chunk_json};
  append_bytes(bytes, std::span<const uint32_t>{head});
  append_bytes(bytes, std::span<const char>{text});
  const uint32_t binary_head[]{static_cast<uint32_t>(doc.binary.size()), chunk_binary};
  append_bytes(bytes, std::span<const uint32_t>{binary_head});
  append_bytes(bytes, std::span<const uint8_t>{doc.binary});
  return bytes;
}

void write_glb(const Scene& scene, const std::filesystem::path& path) {
  const std::vector<uint8_t> bytes = to_glb(scene);
  write_file_atomically(path, std::as_bytes(std::span(bytes)));
}

}  // namespace izb
