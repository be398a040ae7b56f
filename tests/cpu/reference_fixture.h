// SPDX-License-Identifier: MIT
// Small scenes and random numbers for the tests of src/reference.
#pragma once
#include <cstdint>
#include <random>

#include "reference/truth.h"

namespace izb::reference {

/// The same numbers on every platform.
class Random {
 public:
  explicit Random(uint32_t seed) : engine_(seed) {}
  double uniform(double from, double to) { return from + (to - from) * (engine_() * 0x1p-32); }
  glm::vec3 point(double from, double to) {
    const double x = uniform(from, to), y = uniform(from, to), z = uniform(from, to);
    return {x, y, z};
  }

 private:
  std::mt19937 engine_;
};

inline void add_triangle(Triangles& triangles, glm::vec3 a, glm::vec3 b, glm::vec3 c) {
  for (const glm::vec3& v : {a, b, c}) triangles.positions_vs.push_back(v);
}

/// A horizontal rectangle at height y, as two triangles that share the diagonal from (x0, z0) to (x1, z1).
inline void add_rectangle(Triangles& triangles, float x0, float x1, float z0, float z1, float y) {
  const glm::vec3 a{x0, y, z0}, b{x1, y, z0}, c{x1, y, z1}, d{x0, y, z1};
  add_triangle(triangles, a, b, c);
  add_triangle(triangles, a, c, d);
}

inline constexpr uint32_t no_own_triangle = 0xFFFFFFFFu;

inline void add_receiver(Receivers& receivers, const glm::vec3& point, float band = 1e-3f,
                         uint32_t own = no_own_triangle) {
  receivers.points_vs.push_back(point);
  receivers.own_triangle.push_back(own);
  receivers.classes.push_back(PixelClass::receiver);
  receivers.band.push_back(band);
}

/// 32 samples a receiver, spread at random over the pixel.
inline std::vector<glm::dvec2> random_offsets(Random& random) {
  std::vector<glm::dvec2> offsets;
  for (int s = 0; s < 32; ++s) offsets.emplace_back(random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5));
  return offsets;
}

inline constexpr uint32_t dark = 0xFFFFFFFFu;

}  // namespace izb::reference
