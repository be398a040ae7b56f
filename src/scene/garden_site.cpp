// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/garden_parts.h"
#include "scene/shapes.h"

namespace izb::garden {

using glm::dvec2;
using glm::dvec3;

dvec3 on_line(const dvec3& a, const dvec3& b, double sag, double t) {
  return glm::mix(a, b, t) - dvec3{0, 4.0 * sag * t * (1.0 - t), 0};
}

int paving_rows(const Bounds& area) {
  return static_cast<int>(std::lround((area.max.z - area.min.z) / 0.62));
}

Mesh paving(Random& random, const Bounds& area) {
  constexpr double joint = 0.012, bevel = 0.007;
  const int rows = paving_rows(area);
  const double depth = (area.max.z - area.min.z) / rows;
  Mesh mesh;
  mesh.name = "paving";
  for (int row = 0; row < rows; ++row) {
    const double z = area.min.z + depth * row, z_end = z + depth;
    for (double x = area.min.x; x < area.max.x - 0.01;) {
      double x_end = x + random.between(0.55, 1.15);
      if (x_end + 0.4 > area.max.x) x_end = area.max.x;
      // Slabs are laid by hand: a height of their own keeps a joint visible in grazing light.
      const double height = random.between(-0.003, 0.003);
      shapes::add_slab(mesh, {x + joint / 2, -0.05, z + joint / 2}, {x_end - joint / 2, height, z_end - joint / 2},
                       bevel);
      x = x_end;
    }
  }
  return mesh;
}

Mesh raised_bed(double width, double depth) {
  Mesh mesh;
  mesh.name = "raised bed";
  constexpr double border = 0.09, height = 0.13;
  const double x = width / 2, z = depth / 2;
  for (const double side : {-1.0, 1.0}) {
    const double at_z = side * (z - border / 2), at_x = side * (x - border / 2);
    shapes::add_slab(mesh, {-x, sunk, at_z - border / 2}, {x, height, at_z + border / 2}, 0.01);
    shapes::add_slab(mesh, {at_x - border / 2, sunk, -z + border + 0.006},
                     {at_x + border / 2, height, z - border - 0.006}, 0.01);
  }
  return mesh;
}

Mesh steps() {
  Mesh mesh;
  mesh.name = "steps";
  for (int i = 0; i < 3; ++i) {
    const double reach = 1.05 - 0.3 * i, half = 0.95 - 0.12 * i;
    shapes::add_slab(mesh, {-half, sunk, -0.021 - 0.012 * i}, {half, 0.15 * (i + 1), reach}, 0.008);
  }
  return mesh;
}

Mesh urn() {
  // A foot, a waist, a wide shoulder, a neck and a rolled lip; then down inside to the bottom.
  std::vector<dvec2> profile{{0, sunk}, {0.235, sunk}, {0.235, sunk}, {0.235, 0.05}, {0.235, 0.05}, {0.215, 0.075}};
  const auto add_curve = [&](dvec2 a, dvec2 b, dvec2 c, dvec2 d, int count) {
    for (int i = 1; i <= count; ++i) {
      const double t = static_cast<double>(i) / count, s = 1.0 - t;
      profile.push_back(s * s * s * a + 3.0 * s * s * t * b + 3.0 * s * t * t * c + t * t * t * d);
    }
  };
  add_curve({0.215, 0.075}, {0.13, 0.10}, {0.15, 0.17}, {0.20, 0.25}, 10);
  add_curve({0.20, 0.25}, {0.31, 0.43}, {0.47, 0.55}, {0.46, 0.83}, 20);
  add_curve({0.46, 0.83}, {0.455, 1.03}, {0.26, 1.04}, {0.25, 1.16}, 18);
  add_curve({0.25, 1.16}, {0.245, 1.21}, {0.35, 1.20}, {0.35, 1.245}, 8);
  add_curve({0.35, 1.245}, {0.35, 1.28}, {0.29, 1.28}, {0.27, 1.245}, 8);
  add_curve({0.27, 1.245}, {0.22, 1.19}, {0.21, 1.12}, {0.23, 1.05}, 8);
  add_curve({0.23, 1.05}, {0.40, 0.95}, {0.43, 0.85}, {0.40, 0.70}, 8);
  add_curve({0.40, 0.70}, {0.36, 0.50}, {0.20, 0.30}, {0.0, 0.30}, 8);
  Mesh mesh;
  mesh.name = "urn";
  shapes::add_lathe(mesh, profile, 96);
  return mesh;
}

Mesh ball() {
  constexpr int rings = 40;
  std::vector<dvec2> profile;
  for (int i = 0; i <= rings; ++i) {
    const double angle = std::numbers::pi * i / rings;
    profile.push_back({i == 0 || i == rings ? 0.0 : 0.32 * std::sin(angle), 0.31 - 0.32 * std::cos(angle)});
  }
  Mesh mesh;
  mesh.name = "ball";
  shapes::add_lathe(mesh, profile, 80);
  return mesh;
}

Mesh pedestal() {
  Mesh mesh;
  mesh.name = "pedestal";
  shapes::add_box(mesh, {-0.27, sunk, -0.27}, {0.27, 0.10, 0.27});
  shapes::add_box(mesh, {-0.20, 0.09, -0.20}, {0.20, 0.71, 0.20});
  shapes::add_box(mesh, {-0.26, 0.70, -0.26}, {0.26, 0.78, 0.26});
  shapes::add_box(mesh, {-0.23, 0.66, -0.23}, {0.23, 0.705, 0.23});
  return mesh;
}

}  // namespace izb::garden
