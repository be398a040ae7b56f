// SPDX-License-Identifier: MIT
#include "scene/view.h"

#include <cmath>
#include <fstream>
#include <glm/gtc/constants.hpp>
#include <iterator>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "scene/find.h"
#include "scene/pose.h"

namespace izb {
namespace {

using nlohmann::json;

template <typename T>
const T& found(const std::vector<T>& objects, const std::string& name, const char* kind, const std::string& scene) {
  if (const T* const object = find_by_name_or_index(objects, name)) return *object;
  if (objects.empty()) fail("the scene '{}' has no {} '{}': it has none at all", scene, kind, name);
  fail("the scene '{}' has no {} '{}'; there are {}", scene, kind, name, names_of(objects));
}

/// `count` finite numbers of an entry of the views file.
template <typename Vector>
Vector numbers(const json& entry, const char* key, const std::string& where) {
  const json& value = entry.at(key);
  Vector v(0.0);
  bool ok = value.is_array() && value.size() == static_cast<size_t>(Vector::length());
  for (int c = 0; ok && c < Vector::length(); ++c) {
    const json& number = value[static_cast<size_t>(c)];
    ok = number.is_number();
    if (ok) v[c] = number.get<double>();
  }
  if (!ok) fail("{}: '{}' is not an array of {} numbers", where, key, Vector::length());
  return v;
}

}  // namespace

Bounds world_bounds(const Scene& scene) {
  Bounds bounds;
  for (const Instance& instance : scene.instances) {
    if (instance.deforms()) {
      for (const glm::dvec3& p : posed_positions_ws(scene, instance)) bounds.add(p);
    } else {
      for (const glm::vec3& p : scene.meshes[instance.mesh].positions)
        bounds.add(glm::dvec3(instance.world_from_object * glm::dvec4(p, 1.0)));
    }
  }
  return bounds;
}

PosedBounds::PosedBounds(const Scene& scene) {
  for (const Mesh& mesh : scene.meshes) {
    Reach& reach = meshes_.emplace_back();
    for (const glm::vec3& p : mesh.positions) reach.rest.add(p);
    for (const MorphTarget& target : mesh.targets) {
      glm::dvec3& furthest = reach.targets.emplace_back(0.0);
      for (const glm::vec3& p : target.positions) furthest = glm::max(furthest, glm::abs(glm::dvec3(p)));
    }
  }
}

Bounds PosedBounds::of(const Scene& scene) const {
  Bounds all;
  for (const Instance& instance : scene.instances) {
    const Reach& reach = meshes_[instance.mesh];
    if (reach.rest.empty()) continue;
    Bounds box = reach.rest;
    for (size_t t = 0; t < instance.morph_weights.size(); ++t) {
      const glm::dvec3 moved = std::abs(double(instance.morph_weights[t])) * reach.targets[t];
      box.min -= moved, box.max += moved;
    }
    const auto add = [&](const glm::dmat4& place) {
      for (int corner = 0; corner < 8; ++corner)
        all.add(glm::dvec3(place * glm::dvec4(corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y,
                                              corner & 4 ? box.max.z : box.min.z, 1.0)));
    };
    // A skinned vertex lies between where its joints alone would put it.
    if (instance.skin < 0)
      add(instance.world_from_object);
    else
      for (const glm::dmat4& joint : scene.skins[static_cast<size_t>(instance.skin)].world_from_bind) add(joint);
  }
  return all;
}

Camera look_at(const glm::dvec3& eye_ws, const glm::dvec3& target_ws, double yfov_rad) {
  const glm::dvec3 offset = eye_ws - target_ws;
  const double distance = glm::length(offset);
  if (!(distance > 0.0) || !std::isfinite(distance)) fail("a camera's eye and target are the same point");
  const glm::dvec3 z = offset / distance;
  const glm::dvec3 up = std::abs(z.y) < 0.9999 ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, z.y > 0.0 ? -1 : 1);
  const glm::dvec3 x = glm::normalize(glm::cross(up, z));
  Camera camera;
  camera.world_from_view =
      glm::dmat4(glm::dvec4(x, 0.0), glm::dvec4(glm::cross(z, x), 0.0), glm::dvec4(z, 0.0), glm::dvec4(eye_ws, 1.0));
  camera.yfov_rad = yfov_rad;
  camera.near_plane = 1e-4 * distance;
  return camera;
}

Camera default_camera(const Bounds& bounds) {
  constexpr double yfov_rad = glm::radians(45.0);
  const glm::dvec3 center = bounds.empty() ? glm::dvec3(0.0) : bounds.center();
  const double radius = bounds.radius() > 0.0 ? bounds.radius() : 1.0;
  // Three quarters from the front, 25 degrees above; the bounding sphere just fits the height of the picture.
  const glm::dvec3 direction = glm::normalize(glm::dvec3(0.6, 0.45, 0.75));
  Camera camera = look_at(center + radius / std::sin(0.5 * yfov_rad) * direction, center, yfov_rad);
  camera.name = "default";
  camera.near_plane = 1e-4 * radius;
  return camera;
}

const char* type_name(LightType type) {
  switch (type) {
    case LightType::directional:
      return "directional";
    case LightType::spot:
      return "spot";
    default:
      return "point";
  }
}

Light sun(double azimuth_deg, double elevation_deg) {
  const double azimuth_rad = glm::radians(azimuth_deg), elevation_rad = glm::radians(elevation_deg);
  const glm::dvec3 to_sun_ws(std::sin(azimuth_rad) * std::cos(elevation_rad), std::sin(elevation_rad),
                             -std::cos(azimuth_rad) * std::cos(elevation_rad));
  Light light;
  light.name = "sun";
  light.type = LightType::directional;
  light.direction_ws = -to_sun_ws;
  return light;
}

const Camera& find_camera(const Scene& scene, const std::string& name_or_index) {
  return found(scene.cameras, name_or_index, "camera", scene.name);
}

const Light& find_light(const Scene& scene, const std::string& name_or_index) {
  return found(scene.lights, name_or_index, "light", scene.name);
}

Viewpoint read_viewpoint(const std::filesystem::path& views_file, const std::string& name) {
  const std::string path = views_file.string();
  std::ifstream file(views_file, std::ios::binary);
  if (!std::filesystem::is_regular_file(views_file) || !file) fail("cannot read the views file '{}'", path);
  const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  const json root = json::parse(text, nullptr, false);
  if (!root.is_object()) fail("the views file '{}' is not a JSON object", path);
  const auto entry = root.find(name);
  if (entry == root.end()) {
    std::string names;
    for (const auto& [key, value] : root.items()) names += (names.empty() ? "" : ", ") + key;
    fail("the views file '{}' has no view '{}'; there are {}", path, name, names.empty() ? "none" : names);
  }

  const std::string where = fmt::format("view '{}' of '{}'", name, path);
  if (!entry->is_object()) fail("{} is not an object", where);
  for (const char* key : {"eye", "target"})
    if (!entry->contains(key)) fail("{} has no '{}'", where, key);
  Viewpoint view;
  view.eye_ws = numbers<glm::dvec3>(*entry, "eye", where);
  view.target_ws = numbers<glm::dvec3>(*entry, "target", where);
  if (view.eye_ws == view.target_ws) fail("{}: eye and target are the same point", where);
  if (entry->contains("fov")) {
    const json& fov = entry->at("fov");
    if (!fov.is_number() || !(fov.get<double>() > 0.0) || !(fov.get<double>() < 180.0))
      fail("{}: 'fov' is not a number of degrees between 0 and 180", where);
    view.yfov_deg = fov.get<double>();
  }
  if (entry->contains("light")) {
    if (!entry->at("light").is_string()) fail("{}: 'light' is not a string", where);
    view.light = entry->at("light").get<std::string>();
  }
  if (entry->contains("sun")) view.sun_deg = numbers<glm::dvec2>(*entry, "sun", where);
  if (view.light && view.sun_deg) fail("{} has both 'light' and 'sun'", where);
  return view;
}

}  // namespace izb
