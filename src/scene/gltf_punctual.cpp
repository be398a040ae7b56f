// SPDX-License-Identifier: MIT
#include "scene/gltf_punctual.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "scene/pose.h"

namespace izb {
namespace {

std::string object_name(const std::string& node, const std::string& object, const char* kind, size_t index) {
  if (!node.empty()) return node;
  if (!object.empty()) return object;
  return fmt::format("{} {}", kind, index);
}

bool set_projection(const tinygltf::Camera& source, Camera& camera) {
  camera.orthographic = source.type == "orthographic";
  if (camera.orthographic) {
    camera.ymag = std::abs(source.orthographic.ymag);
    camera.near_plane = source.orthographic.znear;
    camera.far_plane = source.orthographic.zfar;
    return camera.ymag > 0.0 && camera.near_plane >= 0.0 && camera.far_plane > camera.near_plane;
  }
  camera.yfov_rad = source.perspective.yfov;
  camera.near_plane = source.perspective.znear;
  const double far = source.perspective.zfar;  // 0: absent, an infinite projection
  if (far != 0.0) camera.far_plane = far;
  return camera.yfov_rad > 0.0 && camera.yfov_rad < std::numbers::pi && camera.near_plane > 0.0 &&
         camera.far_plane > camera.near_plane;
}

bool set_type(const tinygltf::Light& source, Light& light) {
  if (source.type == "directional") {
    light.type = LightType::directional;
  } else if (source.type == "point") {
    light.type = LightType::point;
  } else if (source.type == "spot") {
    light.type = LightType::spot;
    light.inner_cone_rad = source.spot.innerConeAngle;
    light.outer_cone_rad = source.spot.outerConeAngle;
    return light.inner_cone_rad >= 0.0 && light.outer_cone_rad >= light.inner_cone_rad && light.outer_cone_rad > 0.0 &&
           light.outer_cone_rad <= std::numbers::pi / 2 + 1e-6;
  } else {
    return false;
  }
  return true;
}

}  // namespace

void load_cameras(const tinygltf::Model& model, const NodeHierarchy& nodes, Scene& scene) {
  const std::vector<glm::dmat4> world_from_node = world_from_nodes(scene.nodes);
  for (const int i : nodes.in_scene) {
    const tinygltf::Node& node = model.nodes[static_cast<size_t>(i)];
    if (node.camera < 0) continue;
    const tinygltf::Camera& source = model.cameras[static_cast<size_t>(node.camera)];
    Camera camera;
    camera.name = object_name(node.name, source.name, "camera", scene.cameras.size());
    camera.node = nodes.scene_index[static_cast<size_t>(i)];
    if (set_projection(source, camera) && rigid(world_from_node[static_cast<size_t>(camera.node)]))
      scene.cameras.push_back(std::move(camera));
    else
      scene.ignored.push_back(
          fmt::format("camera '{}' is left out: its projection or its transform is not usable", camera.name));
  }
}

void load_lights(const tinygltf::Model& model, const NodeHierarchy& nodes, Scene& scene) {
  const std::vector<glm::dmat4> world_from_node = world_from_nodes(scene.nodes);
  for (const int i : nodes.in_scene) {
    const tinygltf::Node& node = model.nodes[static_cast<size_t>(i)];
    const auto extension = node.extensions.find("KHR_lights_punctual");
    if (extension == node.extensions.end()) continue;
    const auto index = static_cast<size_t>(extension->second.Get("light").GetNumberAsInt());
    const tinygltf::Light& source = model.lights[index];
    Light light;
    light.name = object_name(node.name, source.name, "light", scene.lights.size());
    light.node = nodes.scene_index[static_cast<size_t>(i)];
    const double z_length = glm::length(glm::dvec3(world_from_node[static_cast<size_t>(light.node)][2]));
    if (!set_type(source, light) || (light.type != LightType::point && !(z_length > 0.0))) {
      scene.ignored.push_back(
          fmt::format("light '{}' of type '{}' is left out: its type, its cone or its transform is not usable",
                      light.name, source.type));
      continue;
    }
    for (int c = 0; c < 3 && !source.color.empty(); ++c)
      light.color[c] = static_cast<float>(source.color[static_cast<size_t>(c)]);
    light.intensity = static_cast<float>(source.intensity);
    if (light.type != LightType::directional && source.range > 0.0) light.range = source.range;
    scene.lights.push_back(std::move(light));
  }
}

}  // namespace izb
