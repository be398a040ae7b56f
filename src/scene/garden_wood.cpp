// SPDX-License-Identifier: MIT
#include <cmath>

#include "scene/garden_parts.h"
#include "scene/shapes.h"

namespace izb::garden {

using glm::dvec3;
using shapes::add_beam;
using shapes::add_box;
using shapes::add_rod;

namespace {

/// Diagonal laths in a frame's opening, two layers that cut into each other by a millimetre.
void add_lattice(Mesh& mesh, double left, double right, double bottom, double top, double spacing) {
  constexpr double width = 0.022, thickness = 0.010, overlap = 0.001;
  const double height = top - bottom, step = spacing * std::sqrt(2.0);
  for (const double slope : {1.0, -1.0}) {
    const double z = slope * (thickness - overlap) / 2;
    // The lath through (x, bottom) runs up at 45 degrees; both ends are cut to the opening.
    const double first = slope > 0 ? left - height : left;
    for (double x = first + step / 2; x < right + (slope > 0 ? 0.0 : height); x += step) {
      const auto at = [&](double x_end) { return dvec3{x_end, bottom + slope * (x_end - x), z}; };
      const double x_low = std::max(left, slope > 0 ? x : x - height);
      const double x_high = std::min(right, slope > 0 ? x + height : x);
      if (x_high - x_low > 2 * width) add_beam(mesh, at(x_low), at(x_high), width, thickness, {0, 0, 1});
    }
  }
}

}  // namespace

Mesh trellis(double width, double bottom, double top, double spacing) {
  Mesh mesh;
  mesh.name = "trellis";
  const double half = width / 2;
  for (const double side : {-1.0, 1.0}) {
    const double x = side * (half + 0.02);
    add_box(mesh, {x - 0.03, sunk, -0.03}, {x + 0.03, top + 0.09, 0.03});
  }
  for (const double y : {bottom, top}) add_box(mesh, {-half, y - 0.025, -0.02}, {half, y + 0.025, 0.02});
  add_lattice(mesh, -half, half, bottom, top, spacing);
  return mesh;
}

Mesh pergola(const Bounds& area) {
  Mesh mesh;
  mesh.name = "pergola";
  const dvec3 low = area.min, high = area.max;
  for (const double x : {low.x, high.x}) {
    for (const double z : {low.z, high.z}) {
      add_box(mesh, {x - 0.06, sunk - 0.012, z - 0.06}, {x + 0.06, high.y - 0.02, z + 0.06});
      add_box(mesh, {x - 0.09, sunk - 0.02, z - 0.09}, {x + 0.09, 0.10, z + 0.09});
    }
  }
  for (const double z : {low.z, high.z}) {
    add_box(mesh, {low.x - 0.45, high.y - 0.03, z - 0.04}, {high.x + 0.3, high.y + 0.12, z + 0.04});
  }
  for (double x = low.x - 0.3; x < high.x + 0.2; x += 0.33) {
    add_box(mesh, {x - 0.025, high.y + 0.09, low.z - 0.3}, {x + 0.025, high.y + 0.20, high.z + 0.4});
  }
  for (double z = low.z - 0.2; z < high.z + 0.35; z += 0.155) {
    add_box(mesh, {low.x - 0.4, high.y + 0.19, z - 0.014}, {high.x + 0.25, high.y + 0.215, z + 0.014});
  }
  return mesh;
}

Mesh ladder() {
  Mesh mesh;
  mesh.name = "ladder";
  constexpr double length = 2.9;
  for (const double side : {-1.0, 1.0}) {
    // Slightly closer together at the top, as fruit ladders are.
    add_beam(mesh, {side * 0.24, sunk, 0}, {side * 0.18, length, 0}, 0.028, 0.06, {0, 0, 1});
  }
  for (int i = 0; i < 10; ++i) {
    const double y = 0.24 + 0.275 * i, half = 0.24 - 0.06 * y / length;
    add_rod(mesh, {-half, y, 0}, {half, y, 0}, 0.015, 12);
  }
  return mesh;
}

Mesh chair() {
  Mesh mesh;
  mesh.name = "chair";
  for (const double x : {-0.19, 0.19}) {
    add_beam(mesh, {x, sunk, 0.19}, {x, 0.44, 0.18}, 0.032, 0.032, {0, 0, 1});
    add_beam(mesh, {x, sunk, -0.21}, {x, 0.44, -0.18}, 0.033, 0.033, {0, 0, 1});
    add_beam(mesh, {x, 0.42, -0.181}, {x, 0.95, -0.26}, 0.031, 0.028, {0, 0, 1});
    add_box(mesh, {x - 0.012, 0.385, -0.19}, {x + 0.012, 0.433, 0.19});
    add_box(mesh, {x - 0.010, 0.16, -0.19}, {x + 0.010, 0.185, 0.19});
  }
  for (const double z : {-0.175, 0.175}) add_box(mesh, {-0.19, 0.387, z - 0.011}, {0.19, 0.431, z + 0.011});
  for (int i = 0; i < 6; ++i) {
    const double z = -0.165 + 0.073 * i;
    add_box(mesh, {-0.225, 0.430, z - 0.026}, {0.225, 0.448, z + 0.026});
  }
  for (int i = 0; i < 5; ++i) {
    const double x = -0.128 + 0.064 * i;
    add_beam(mesh, {x, 0.56, -0.203}, {x, 0.91, -0.253}, 0.024, 0.011, {0, 0, 1});
  }
  for (const double y : {0.55, 0.915}) {
    const double z = -0.181 - 0.079 * (y - 0.42) / 0.53;
    add_box(mesh, {-0.19, y - 0.03, z - 0.010}, {0.19, y + 0.03, z + 0.010});
  }
  return mesh;
}

Mesh crate() {
  Mesh mesh;
  mesh.name = "crate";
  constexpr double half_x = 0.25, half_z = 0.17, height = 0.30;
  for (const double x : {-1.0, 1.0}) {
    for (const double z : {-1.0, 1.0}) {
      const double px = x * (half_x - 0.02), pz = z * (half_z - 0.02);
      add_box(mesh, {px - 0.015, 0.004, pz - 0.015}, {px + 0.015, height - 0.006, pz + 0.015});
    }
  }
  for (int i = 0; i < 3; ++i) {
    const double y = 0.012 + 0.1 * i;
    for (const double side : {-1.0, 1.0}) {
      const double z = side * half_z, x = side * half_x;
      add_box(mesh, {-half_x - 0.006, y, z - 0.006}, {half_x + 0.006, y + 0.075, z + 0.006});
      add_box(mesh, {x - 0.0055, y + 0.001, -half_z + 0.004}, {x + 0.0055, y + 0.074, half_z - 0.004});
    }
  }
  for (int i = 0; i < 4; ++i) {
    const double z = -half_z + 0.01 + 0.083 * i;
    add_box(mesh, {-half_x + 0.002, sunk * 0.2, z}, {half_x - 0.002, 0.010, z + 0.07});
  }
  return mesh;
}

Mesh door() {
  Mesh mesh;
  mesh.name = "door";
  constexpr double half = 0.5, height = 2.1;
  add_box(mesh, {-half - 0.01, -0.02, -0.05}, {half + 0.01, height + 0.01, 0.03});
  for (const double side : {-1.0, 1.0}) {
    const double x = side * (half + 0.05);
    add_box(mesh, {x - 0.05, -0.03, -0.04}, {x + 0.05, height + 0.02, 0.08});
  }
  add_box(mesh, {-half - 0.13, height, -0.045}, {half + 0.13, height + 0.12, 0.11});
  for (int i = 0; i < 6; ++i) {
    const double x = -half + 0.015 + i * 0.164;
    add_box(mesh, {x, -0.015, 0.02}, {x + 0.15, height - 0.01, 0.043});
  }
  for (const double y : {0.35, 1.05, 1.75}) add_box(mesh, {-0.47, y - 0.05, 0.036}, {0.47, y + 0.05, 0.062});
  add_rod(mesh, {0.40, 1.0, 0.04}, {0.40, 1.0, 0.13}, 0.012, 12);
  add_rod(mesh, {0.425, 1.0, 0.115}, {0.29, 1.0, 0.115}, 0.011, 12);
  return mesh;
}

Mesh shutters() {
  Mesh mesh;
  mesh.name = "shutters";
  constexpr double half = 0.30, height = 1.25;
  for (const double centre : {-0.66, 0.66}) {
    for (const double side : {-1.0, 1.0}) {
      const double x = centre + side * (half - 0.03);
      add_box(mesh, {x - 0.03, 0, -0.01}, {x + 0.03, height, 0.05});
    }
    for (const double y : {0.003, height / 2 - 0.03, height - 0.063}) {
      add_box(mesh, {centre - half + 0.04, y, -0.012}, {centre + half - 0.04, y + 0.06, 0.047});
    }
    for (int i = 0; i < 23; ++i) {
      const double y = 0.085 + 0.047 * i;
      add_beam(mesh, {centre - half + 0.05, y, 0.022}, {centre + half - 0.05, y, 0.022}, 0.048, 0.007, {0, 1.0, 0.9});
    }
  }
  add_box(mesh, {-0.36, -0.07, -0.02}, {0.36, -0.01, 0.11});
  add_box(mesh, {-0.35, -0.02, -0.03}, {0.35, height + 0.02, 0.012});
  for (int i = 0; i < 6; ++i) {
    const double x = -0.275 + 0.11 * i;
    add_rod(mesh, {x, -0.02, 0.07}, {x, height + 0.04, 0.07}, 0.007, 10);
  }
  for (const double y : {0.30, 0.95}) add_rod(mesh, {-0.34, y, 0.071}, {0.34, y, 0.071}, 0.006, 10);
  return mesh;
}

Mesh railing(double length) {
  Mesh mesh;
  mesh.name = "railing";
  const double half = length / 2;
  const int count = static_cast<int>(length / 0.13);
  for (int i = 0; i <= count; ++i) {
    const double x = -half + length * i / count;
    const double top = i % 2 == 0 ? 1.22 : 1.06;
    add_rod(mesh, {x, sunk, 0}, {x, top, 0}, 0.007, 10);
    if (i % 2 == 0) shapes::add_ring(mesh, {x, top + 0.040, 0}, {0, 0, 1}, 0.040, 0.006, 20, 8);
  }
  for (const double y : {0.14, 0.98}) add_box(mesh, {-half - 0.03, y - 0.006, -0.014}, {half + 0.03, y + 0.006, 0.014});
  return mesh;
}

}  // namespace izb::garden
