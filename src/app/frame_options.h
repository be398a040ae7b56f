// SPDX-License-Identifier: MIT
// What the commands that render have in common on the command line: which frame, by which technique.
#pragma once
#include <memory>
#include <optional>
#include <string>

#include "base/options.h"
#include "scene/camera_path.h"
#include "scene/pose.h"
#include "scene/scene.h"
#include "scene/view.h"
#include "shadow/technique.h"

namespace izb {

/// Values of the shared options, with their defaults.
struct FrameOptions {
  std::string size = "1280x720";
  std::string camera, camera_path, eye, target;
  double fov_deg = 45.0;
  std::string light, light_position, light_direction, sun, spot, point;
  std::string viewpoint;
  std::string animation;
  double time_s = -1.0;
  bool loop = false;
  std::string views = "bench/views.json";
  std::string technique = "izb";
  std::string preset;
  std::string context = "auto";

  /// Declares them; `technique` and `context` choices come from the registries. Without the technique: nor its preset.
  OptionSet options(bool with_technique = true);
  /// Whether the scene's animations play; they do not: at rest.
  bool plays() const;
};

/// A light's name as a layer of an image's channels, where a dot would begin another layer.
std::string layer_name(std::string name);

struct Size {
  int width_px, height_px;
  /// Rounded, at least 1 x 1.
  Size scaled(double scale) const;
};

/// Where a light was put, whatever its node says.
struct LightPlace {
  std::optional<glm::dvec3> position_ws, direction_ws;  ///< the direction has unit length
};

/// A frame that the person asked for, with what had to be chosen for them said on stderr.
struct FrameChoice {
  Size size;
  Camera camera;
  std::optional<CameraPath> path;  ///< that the camera follows
  std::vector<Light> lights;       ///< at least one; no two have the same layer_name()

  std::vector<LightPlace> places{};  ///< of the first lights
  /// Camera and lights to where their nodes, or the path or the places, are at that moment.
  void move(const Poser& poser, double time_s);
  /// Lights to their places.
  void place_lights();
};

/// Throws izb::UsageError for text that does not parse or options that exclude each other, izb::Error for names that
/// the scene does not have.
FrameChoice choose_frame(const FrameOptions& options, const Scene& scene);

/// X,Y,Z of that option. Throws izb::UsageError.
glm::dvec3 parse_vector(const std::string& option, const std::string& text);

/// WIDTHxHEIGHT. Throws izb::UsageError.
Size parse_size(const std::string& text);

}  // namespace izb
