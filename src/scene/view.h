// SPDX-License-Identifier: MIT
// Which camera and which light a frame uses: named by the scene, given by the person, or made from the scene's bounds.
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace izb {

/// Bounds of all instances' vertices in world space.
Bounds world_bounds(const Scene& scene);

/// Bounds that hold all instances' vertices as they are posed now, found from boxes alone: for every frame of an
/// animation.
class PosedBounds {
 public:
  /// Reads every vertex once.
  explicit PosedBounds(const Scene& scene);
  /// Of the scene that it was made of, in any pose.
  Bounds of(const Scene& scene) const;

 private:
  struct Reach {
    Bounds rest;
    std::vector<glm::dvec3> targets;  ///< how far each morph target moves a vertex along each axis, at most
  };
  std::vector<Reach> meshes_;
};

/// A perspective camera at `eye_ws` that looks at `target_ws`, +y up (or another axis if the view is along y).
Camera look_at(const glm::dvec3& eye_ws, const glm::dvec3& target_ws, double yfov_rad);

/// A camera framed on the scene's bounds, for a scene that has none.
Camera default_camera(const Bounds& bounds);

/// "directional", "spot" or "point", as KHR_lights_punctual calls them.
const char* type_name(LightType type);

/// The sun: azimuth clockwise from -z (north) seen from above, elevation above the horizon, both in degrees.
Light sun(double azimuth_deg, double elevation_deg);

/// The scene's camera or light by name or by index. Throws izb::Error that lists the names there are.
const Camera& find_camera(const Scene& scene, const std::string& name_or_index);
const Light& find_light(const Scene& scene, const std::string& name_or_index);

/// A named view of a scene, as stored in bench/views.json.
struct Viewpoint {
  glm::dvec3 eye_ws{0.0}, target_ws{0.0};
  double yfov_deg = 45.0;
  std::optional<std::string> light;   ///< a light of the scene, or
  std::optional<glm::dvec2> sun_deg;  ///< azimuth, elevation
};

/// Reads one entry of a views file: {"NAME": {"eye": [x,y,z], "target": [x,y,z], "fov": degrees, "sun": [az,el]
/// | "light": "NAME"}}. Throws izb::Error naming the file and what is wrong or which names there are.
Viewpoint read_viewpoint(const std::filesystem::path& views_file, const std::string& name);

}  // namespace izb
