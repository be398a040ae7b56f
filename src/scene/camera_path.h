// SPDX-License-Identifier: MIT
// A camera that flies through key frames.
#pragma once
#include <filesystem>
#include <vector>

#include "scene/scene.h"

namespace izb {

/// Key frames, and the smooth way through them: each coordinate is a cubic Hermite spline whose tangent at a key is
/// that of the parabola through it and its two neighbours (for keys at unequal times; Bessel's tangents, de Boor 1978),
/// so that the speed has no jump. Before the first key the camera stands at it, after the last at that.
struct CameraPath {
  struct Key {
    double time_s = 0.0;
    glm::dvec3 eye_ws{0.0}, target_ws{0.0};
    double yfov_deg = 45.0;
  };
  std::vector<Key> keys;  ///< at least one, times ascending

  Camera at(double time_s) const;
};

/// Reads {"keys": [{"time": seconds, "eye": [x,y,z], "target": [x,y,z], "fov": degrees}, ...]}; a key without "fov" has
/// the one before it. Throws izb::Error naming the file and what is wrong.
CameraPath read_camera_path(const std::filesystem::path& file);

}  // namespace izb
