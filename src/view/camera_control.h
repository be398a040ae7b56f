// SPDX-License-Identifier: MIT
// How a person moves the camera and the lights: arithmetic alone, in world space and double.
#pragma once
#include <glm/glm.hpp>
#include <string>

#include "app/frame_options.h"
#include "scene/scene.h"

namespace izb {

/// A camera that looks at a point, +y up. It never tips over: the view stays a degree away from straight up and down.
struct CameraPose {
  glm::dvec3 eye_ws{0.0, 0.0, 1.0}, target_ws{0.0};
  double yfov_deg = 45.0;

  /// Of a camera of the scene, with its focus at that distance. A roll is lost, and an orthographic camera becomes a
  /// perspective one that shows as much at that distance.
  static CameraPose of(const Camera& camera, double focus_distance);

  /// As --eye, --target and --fov say. Throws izb::UsageError.
  static CameraPose of(const FrameOptions& options);

  double distance() const { return glm::length(target_ws - eye_ws); }
  glm::dvec3 forward() const { return (target_ws - eye_ws) / distance(); }
  glm::dvec3 right() const;
  glm::dvec3 up() const { return glm::cross(right(), forward()); }
  /// World units that a pixel is wide at the focus.
  double pixel_ws(int height_px) const;

  /// Around the focus, by angles in radians.
  void orbit(double azimuth_rad, double elevation_rad);
  /// Turns the view where the eye stands.
  void look(double azimuth_rad, double elevation_rad);
  /// Moves eye and focus alike: right, up, forward in world units.
  void move(const glm::dvec3& step);
  /// Scales the distance from the focus, which stays above what doubles can tell apart there.
  void approach(double factor);
  /// Looks at that point from where the eye stands.
  void focus(const glm::dvec3& point_ws);

  /// Sets --eye, --target and --fov, and clears what excludes them.
  void put_into(FrameOptions& options) const;
};

/// "x,y,z", the shortest text that reads as the same doubles.
std::string text_of(const glm::dvec3& v);

/// The world-space point that a pixel shows; `eye_distance` as the G-buffer has it, px from the upper left.
glm::dvec3 point_of_pixel(const Camera& camera, int width_px, int height_px, const glm::dvec2& px, double eye_distance);

/// Turns the direction in which a light shines by a drag: radians around the vertical and towards the zenith.
glm::dvec3 turned(const glm::dvec3& direction_ws, double azimuth_rad, double elevation_rad);

/// Writes into the options that the light number `index` of `lights`, which they chose, now shines along that direction
/// or from that position. Lights of the scene keep their name.
void put_light(FrameOptions& options, const std::vector<Light>& lights, size_t index, const Light& moved);

}  // namespace izb
