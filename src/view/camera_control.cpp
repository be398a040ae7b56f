// SPDX-License-Identifier: MIT
#include "view/camera_control.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "scene/find.h"

namespace izb {
namespace {

const glm::dvec3 zenith(0.0, 1.0, 0.0);
constexpr double steepest_rad = glm::half_pi<double>() - 0.0175;

/// Azimuth clockwise from -z seen from above, and elevation.
struct Angles {
  double azimuth, elevation;
  explicit Angles(const glm::dvec3& direction)
      : azimuth(std::atan2(direction.x, -direction.z)),
        elevation(std::asin(std::clamp(direction.y / glm::length(direction), -1.0, 1.0))) {}
  glm::dvec3 direction() const {
    return {std::sin(azimuth) * std::cos(elevation), std::sin(elevation), -std::cos(azimuth) * std::cos(elevation)};
  }
};

Angles turned_by(const glm::dvec3& direction, double azimuth_rad, double elevation_rad) {
  Angles a(direction);
  a.azimuth += azimuth_rad;
  a.elevation = std::clamp(a.elevation + elevation_rad, -steepest_rad, steepest_rad);
  return a;
}

std::string joined(const std::vector<std::string>& parts) {
  std::string text;
  for (size_t i = 0; i < parts.size(); ++i) text += (i == 0 ? "" : ";") + parts[i];
  return text;
}

/// Sets one entry of a list with as many entries as there are lights; a list of empty ones alone becomes none.
void set_entry(std::string& list, size_t count, size_t index, const std::string& value) {
  std::vector<std::string> parts = list_of(list);
  parts.resize(count);
  parts[index] = value;
  list = joined(parts);
}

}  // namespace

CameraPose CameraPose::of(const Camera& camera, double focus_distance) {
  const glm::dvec3 eye(camera.world_from_view[3]), forward(-camera.world_from_view[2]);
  CameraPose pose{eye, eye + focus_distance * forward, glm::degrees(camera.yfov_rad)};
  if (camera.orthographic) {
    pose.yfov_deg = 45.0;
    pose.eye_ws = pose.target_ws - forward * (camera.ymag / std::tan(glm::radians(0.5 * pose.yfov_deg)));
  }
  pose.look(0.0, 0.0);
  return pose;
}

CameraPose CameraPose::of(const FrameOptions& options) {
  return {parse_vector("eye", options.eye), parse_vector("target", options.target), options.fov_deg};
}

glm::dvec3 CameraPose::right() const {
  return glm::normalize(glm::cross(forward(), zenith));
}

double CameraPose::pixel_ws(int height_px) const {
  return 2.0 * distance() * std::tan(glm::radians(0.5 * yfov_deg)) / std::max(height_px, 1);
}

void CameraPose::orbit(double azimuth_rad, double elevation_rad) {
  eye_ws = target_ws - distance() * turned_by(forward(), azimuth_rad, elevation_rad).direction();
}

void CameraPose::look(double azimuth_rad, double elevation_rad) {
  target_ws = eye_ws + distance() * turned_by(forward(), azimuth_rad, elevation_rad).direction();
}

void CameraPose::move(const glm::dvec3& step) {
  const glm::dvec3 way = step.x * right() + step.y * up() + step.z * forward();
  eye_ws += way;
  target_ws += way;
}

void CameraPose::approach(double factor) {
  const double nearest = 1e-9 * (1.0 + glm::length(target_ws)), farthest = 1e12;
  eye_ws = target_ws - std::clamp(factor * distance(), nearest, farthest) * forward();
}

void CameraPose::focus(const glm::dvec3& point_ws) {
  if (glm::length(point_ws - eye_ws) > 0.0) target_ws = point_ws;
  look(0.0, 0.0);
}

void CameraPose::put_into(FrameOptions& options) const {
  options.camera.clear();
  options.camera_path.clear();
  options.viewpoint.clear();
  options.eye = text_of(eye_ws);
  options.target = text_of(target_ws);
  options.fov_deg = yfov_deg;
}

std::string text_of(const glm::dvec3& v) {
  return fmt::format("{},{},{}", v.x, v.y, v.z);
}

glm::dvec3 point_of_pixel(const Camera& camera, int width_px, int height_px, const glm::dvec2& px,
                          double eye_distance) {
  const double aspect = double(width_px) / height_px;
  const glm::dvec2 ndc(2.0 * px.x / width_px - 1.0, 1.0 - 2.0 * px.y / height_px);
  const double half = camera.orthographic ? camera.ymag : std::tan(0.5 * camera.yfov_rad) * eye_distance;
  return glm::dvec3(camera.world_from_view * glm::dvec4(ndc.x * half * aspect, ndc.y * half, -eye_distance, 1.0));
}

glm::dvec3 turned(const glm::dvec3& direction_ws, double azimuth_rad, double elevation_rad) {
  return turned_by(direction_ws, azimuth_rad, elevation_rad).direction();
}

void put_light(FrameOptions& options, const std::vector<Light>& lights, size_t index, const Light& moved) {
  // The lights stand in the order of the options: the scene's, suns, spots, points.
  const size_t suns = list_of(options.sun).size(), spots = list_of(options.spot).size(),
               points = list_of(options.point).size(), own = suns + spots + points;
  const size_t of_scene = lights.size() - std::min(own, lights.size());
  if (index < of_scene) {
    if (moved.type != LightType::point)
      set_entry(options.light_direction, of_scene, index, text_of(moved.direction_ws));
    if (moved.type != LightType::directional)
      set_entry(options.light_position, of_scene, index, text_of(moved.position_ws));
    return;
  }
  index -= of_scene;
  if (index < suns) {
    const Angles a(-moved.direction_ws);
    return set_entry(options.sun, suns, index,
                     fmt::format("{},{}", glm::degrees(a.azimuth), glm::degrees(a.elevation)));
  }
  index -= suns;
  if (index < spots)
    return set_entry(options.spot, spots, index,
                     fmt::format("{},{},{}", text_of(moved.position_ws),
                                 text_of(moved.position_ws + moved.direction_ws), glm::degrees(moved.outer_cone_rad)));
  index -= spots;
  if (index < points) set_entry(options.point, points, index, text_of(moved.position_ws));
}

}  // namespace izb
