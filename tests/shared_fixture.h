// SPDX-License-Identifier: MIT
// Cameras and lights for tests of the text that GLSL and C++ share.
#pragma once
#include <random>

#include "shared/bounds.h"
#include "shared/micro_quad.h"
#include "shared/occlusion.h"

namespace izb::test {

/// The same numbers on every platform.
class Random {
 public:
  explicit Random(uint32_t seed) : engine_(seed) {}
  double uniform(double from, double to) { return from + (to - from) * (engine_() * 0x1p-32); }
  uint32_t below(uint32_t count) { return engine_() % count; }
  glm::dvec3 point(double reach) { return {uniform(-reach, reach), uniform(-reach, reach), uniform(-reach, reach)}; }
  glm::dvec3 direction() {
    for (;;) {
      const glm::dvec3 p = point(1.0);
      if (const double length = glm::length(p); length > 0.1 && length < 1.0) return p / length;
    }
  }

 private:
  std::mt19937 engine_;
};

/// A perspective camera of 1080 rows and 45 degrees.
inline shared::CameraFrame perspective_camera(int width_px = 1920, int height_px = 1080) {
  const double half_height = 0.41421356, half_width = half_height * width_px / height_px;
  shared::CameraFrame camera{};
  camera.pixel_ray = glm::vec4(2.0 * half_width / width_px, 2.0 * half_height / height_px, -half_width, -half_height);
  camera.footprint = glm::vec4(2.0 * half_height / height_px, 0.0, 1.0, 0.0);
  camera.size_px = glm::uvec4(width_px, height_px, 0, 0);
  return camera;
}

/// A light that shines along `way`: directional, or a spot at `position`.
inline shared::LightFrame make_light(const glm::dvec3& way, const glm::dvec3* position, uint32_t grid = 256) {
  const glm::dvec3 z = glm::normalize(way);
  const glm::dvec3 hint = std::abs(z.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 x = glm::normalize(glm::cross(hint, z)), y = glm::cross(z, x);
  shared::LightFrame light{};
  light.axis_x = glm::vec4(glm::vec3(x), 0.0f);
  light.axis_y = glm::vec4(glm::vec3(y), 0.0f);
  light.axis_z = glm::vec4(glm::vec3(z), 0.0f);
  light.origin = position ? glm::vec4(glm::vec3(*position), 1.0f) : glm::vec4(0.0f);
  light.to_light = glm::vec4(-glm::vec3(z), 0.5f);
  light.color = glm::vec4(1.0f);
  light.grid = glm::uvec4(grid, 0, 0, 0);
  return light;
}

/// shared::micro_quad_point from the same floats, in double.
inline glm::dvec3 point_in_double(const shared::MicroQuad& quad, const glm::dvec2& o) {
  return glm::dvec3(quad.center) + (glm::dvec3(quad.along_x) * o.x + glm::dvec3(quad.along_y) * o.y) /
                                       (1.0 + o.x * quad.slope.x + o.y * quad.slope.y);
}

}  // namespace izb::test
