// SPDX-License-Identifier: MIT
#include "scene/glb_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/gtc/type_precision.hpp>
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
constexpr int component_float = 5126, component_uint = 5125, component_ushort = 5123;
constexpr int target_vertices = 34962, target_indices = 34963, no_target = 0;
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
  Json view{{"buffer", 0}, {"byteOffset", offset}, {"byteLength", values.size_bytes()}};
  if (target != no_target) view["target"] = target;
  doc.json["bufferViews"].push_back(std::move(view));
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

size_t add_positions(Document& doc, const std::vector<glm::vec3>& positions) {
  const size_t accessor =
      add_accessor(doc, std::span<const glm::vec3>{positions}, "VEC3", component_float, target_vertices);
  glm::vec3 low = positions.front(), high = low;
  for (const glm::vec3& p : positions) low = glm::min(low, p), high = glm::max(high, p);
  doc.json["accessors"][accessor]["min"] = numbers(low);
  doc.json["accessors"][accessor]["max"] = numbers(high);
  return accessor;
}

/// Joints and weights in sets of four, as glTF has them, the last filled up with zeros.
void add_influences(Document& doc, const Mesh& mesh, Json& attributes) {
  constexpr uint32_t set_size = 4;
  for (uint32_t set = 0; set * set_size < mesh.influences; ++set) {
    std::vector<glm::u16vec4> joints(mesh.positions.size(), glm::u16vec4{0});
    std::vector<glm::vec4> weights(mesh.positions.size(), glm::vec4{0.0f});
    for (size_t v = 0; v < mesh.positions.size(); ++v)
      for (uint32_t k = set * set_size; k < std::min((set + 1) * set_size, mesh.influences); ++k) {
        joints[v][int(k % set_size)] = mesh.joints[v * mesh.influences + k];
        weights[v][int(k % set_size)] = mesh.weights[v * mesh.influences + k];
      }
    attributes[fmt::format("JOINTS_{}", set)] =
        add_accessor(doc, std::span<const glm::u16vec4>{joints}, "VEC4", component_ushort, target_vertices);
    attributes[fmt::format("WEIGHTS_{}", set)] =
        add_accessor(doc, std::span<const glm::vec4>{weights}, "VEC4", component_float, target_vertices);
  }
}

Json target_json(Document& doc, const MorphTarget& target) {
  Json out = Json::object();
  if (!target.positions.empty()) out["POSITION"] = add_positions(doc, target.positions);
  if (!target.normals.empty())
    out["NORMAL"] =
        add_accessor(doc, std::span<const glm::vec3>{target.normals}, "VEC3", component_float, target_vertices);
  return out;
}

Json mesh_json(Document& doc, const Mesh& mesh) {
  if (mesh.indices.empty()) fail("mesh \"{}\" has no triangle, and glTF has no empty mesh", mesh.name);
  Json attributes;
  attributes["POSITION"] = add_positions(doc, mesh.positions);
  if (!mesh.normals.empty()) {
    attributes["NORMAL"] =
        add_accessor(doc, std::span<const glm::vec3>{mesh.normals}, "VEC3", component_float, target_vertices);
  }
  if (!mesh.uvs.empty()) {
    attributes["TEXCOORD_0"] =
        add_accessor(doc, std::span<const glm::vec2>{mesh.uvs}, "VEC2", component_float, target_vertices);
  }
  if (mesh.influences > 0) add_influences(doc, mesh, attributes);
  const size_t indices =
      add_accessor(doc, std::span<const uint32_t>{mesh.indices}, "SCALAR", component_uint, target_indices);
  Json primitive{{"attributes", attributes}, {"indices", indices}, {"material", mesh.material}};
  for (const MorphTarget& target : mesh.targets) primitive["targets"].push_back(target_json(doc, target));
  return {{"name", mesh.name}, {"primitives", Json::array({primitive})}};
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

Json node_json(const Node& node) {
  Json out{{"name", node.name}};
  if (node.matrix) {
    out["matrix"] = matrix(*node.matrix);
  } else {
    const glm::dquat& q = node.rotation;
    if (node.translation != glm::dvec3{0.0}) out["translation"] = numbers(node.translation);
    if (q != glm::dquat{1.0, 0.0, 0.0, 0.0}) out["rotation"] = {q.x, q.y, q.z, q.w};
    if (node.scale != glm::dvec3{1.0}) out["scale"] = numbers(node.scale);
  }
  if (!node.morph_weights.empty()) out["weights"] = node.morph_weights;
  return out;
}

/// What stands in the world comes first, a node each; then the scene's own nodes, from `first_own` on, which carry what
/// they place.
struct Nodes {
  Json json = Json::array();
  Json roots = Json::array();
  size_t first_own = 0;

  void add_root(Json node) {
    roots.push_back(json.size());
    json.push_back(std::move(node));
  }
  Json& own(int node) { return json[first_own + static_cast<size_t>(node)]; }
};

void add_instance(Nodes& nodes, const Scene& scene, const Instance& instance) {
  Json carrier{{"name", scene.meshes[instance.mesh].name}, {"mesh", instance.mesh}};
  if (instance.skin >= 0) carrier["skin"] = instance.skin;
  if (instance.node < 0) {
    // A skin places its mesh by itself.
    if (instance.skin < 0 && instance.world_from_object != glm::dmat4{1.0})
      carrier["matrix"] = matrix(instance.world_from_object);
    if (!instance.morph_weights.empty()) carrier["weights"] = instance.morph_weights;
    return nodes.add_root(std::move(carrier));
  }
  Json& own = nodes.own(instance.node);
  if (!own.contains("mesh")) {
    own["mesh"] = instance.mesh;
    if (instance.skin >= 0) own["skin"] = instance.skin;
    return;
  }
  if (!instance.morph_weights.empty() || !scene.nodes[static_cast<size_t>(instance.node)].morph_weights.empty())
    fail("two meshes of node \"{}\" share its morph weights, which the GLB writer does not write",
         scene.nodes[static_cast<size_t>(instance.node)].name);
  own["children"].push_back(nodes.json.size());
  nodes.json.push_back(std::move(carrier));
}

Nodes make_nodes(const Scene& scene) {
  const auto placed_alone = [](const auto& things) {
    return std::count_if(things.begin(), things.end(), [](const auto& thing) { return thing.node < 0; });
  };
  Nodes nodes;
  nodes.first_own = size_t(placed_alone(scene.instances) + placed_alone(scene.cameras) + placed_alone(scene.lights));
  for (const Instance& instance : scene.instances)
    if (instance.node < 0) add_instance(nodes, scene, instance);
  for (size_t i = 0; i < scene.cameras.size(); ++i) {
    const Camera& camera = scene.cameras[i];
    if (camera.node < 0)
      nodes.add_root({{"name", camera.name}, {"camera", i}, {"matrix", matrix(camera.world_from_view)}});
  }
  for (size_t i = 0; i < scene.lights.size(); ++i) {
    const Light& light = scene.lights[i];
    if (light.node < 0)
      nodes.add_root({{"name", light.name},
                      {"matrix", matrix(world_from_light(light))},
                      {"extensions", {{"KHR_lights_punctual", {{"light", i}}}}}});
  }
  for (const Node& node : scene.nodes) nodes.json.push_back(node_json(node));
  for (size_t i = 0; i < scene.nodes.size(); ++i) {
    const size_t index = nodes.first_own + i;
    if (scene.nodes[i].parent < 0)
      nodes.roots.push_back(index);
    else
      nodes.own(scene.nodes[i].parent)["children"].push_back(index);
  }
  for (size_t i = 0; i < scene.cameras.size(); ++i)
    if (scene.cameras[i].node >= 0) nodes.own(scene.cameras[i].node)["camera"] = i;
  for (size_t i = 0; i < scene.lights.size(); ++i)
    if (scene.lights[i].node >= 0) nodes.own(scene.lights[i].node)["extensions"]["KHR_lights_punctual"]["light"] = i;
  for (const Instance& instance : scene.instances)
    if (instance.node >= 0) add_instance(nodes, scene, instance);
  return nodes;
}

Json skin_json(Document& doc, const Skin& skin, size_t first_own) {
  std::vector<glm::mat4> joint_from_bind;
  for (const glm::dmat4& m : skin.joint_from_bind) joint_from_bind.emplace_back(m);
  Json out;
  out["inverseBindMatrices"] =
      add_accessor(doc, std::span<const glm::mat4>{joint_from_bind}, "MAT4", component_float, no_target);
  for (const uint32_t joint : skin.joints) out["joints"].push_back(first_own + joint);
  return out;
}

size_t add_times(Document& doc, const std::vector<float>& times_s) {
  const size_t accessor = add_accessor(doc, std::span<const float>{times_s}, "SCALAR", component_float, no_target);
  doc.json["accessors"][accessor]["min"] = Json::array({times_s.front()});
  doc.json["accessors"][accessor]["max"] = Json::array({times_s.back()});
  return accessor;
}

size_t add_key_values(Document& doc, const Track& track) {
  const std::vector<float>& values = track.values;
  const auto add = [&]<typename Vector>(const Vector*, const char* type) {
    const std::span<const Vector> whole{reinterpret_cast<const Vector*>(values.data()),
                                        values.size() / size_t(Vector::length())};
    return add_accessor(doc, whole, type, component_float, no_target);
  };
  switch (track.property) {
    case AnimatedProperty::rotation:
      return add(static_cast<const glm::vec4*>(nullptr), "VEC4");
    case AnimatedProperty::morph_weights:
      return add_accessor(doc, std::span<const float>{values}, "SCALAR", component_float, no_target);
    case AnimatedProperty::translation:
    case AnimatedProperty::scale:
      break;
  }
  return add(static_cast<const glm::vec3*>(nullptr), "VEC3");
}

const char* name_of(Interpolation interpolation) {
  switch (interpolation) {
    case Interpolation::step:
      return "STEP";
    case Interpolation::cubic_spline:
      return "CUBICSPLINE";
    case Interpolation::linear:
      break;
  }
  return "LINEAR";
}

const char* name_of(AnimatedProperty property) {
  switch (property) {
    case AnimatedProperty::rotation:
      return "rotation";
    case AnimatedProperty::scale:
      return "scale";
    case AnimatedProperty::morph_weights:
      return "weights";
    case AnimatedProperty::translation:
      break;
  }
  return "translation";
}

Json animation_json(Document& doc, const Animation& animation, size_t first_own) {
  Json channels = Json::array(), samplers = Json::array();
  const std::vector<float>* last_times = nullptr;
  size_t times = 0;
  for (const Track& track : animation.tracks) {
    if (!last_times || *last_times != track.times_s) times = add_times(doc, track.times_s);
    last_times = &track.times_s;
    const size_t values = add_key_values(doc, track);
    channels.push_back({{"sampler", samplers.size()},
                        {"target", {{"node", first_own + track.node}, {"path", name_of(track.property)}}}});
    samplers.push_back({{"input", times}, {"interpolation", name_of(track.interpolation)}, {"output", values}});
  }
  return {{"name", animation.name}, {"channels", std::move(channels)}, {"samplers", std::move(samplers)}};
}

Document make_document(const Scene& scene) {
  if (!scene.textures.empty()) {
    fail("scene \"{}\" has textures, which the GLB writer does not write", scene.name);
  }
  Document doc;
  doc.json["asset"] = {{"version", "2.0"}, {"generator", "izb"}};
  doc.json["scene"] = 0;
  Nodes nodes = make_nodes(scene);
  doc.json["scenes"] = Json::array({{{"name", scene.name}, {"nodes", std::move(nodes.roots)}}});
  doc.json["nodes"] = std::move(nodes.json);
  for (const Material& material : scene.materials) doc.json["materials"].push_back(material_json(material));
  for (const Camera& camera : scene.cameras) doc.json["cameras"].push_back(camera_json(camera));
  for (const Mesh& mesh : scene.meshes) {
    Json entry = mesh_json(doc, mesh);
    doc.json["meshes"].push_back(std::move(entry));
  }
  for (const Skin& skin : scene.skins) {
    Json entry = skin_json(doc, skin, nodes.first_own);
    doc.json["skins"].push_back(std::move(entry));
  }
  for (const Animation& animation : scene.animations) {
    Json entry = animation_json(doc, animation, nodes.first_own);
    doc.json["animations"].push_back(std::move(entry));
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
