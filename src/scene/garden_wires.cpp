// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>
#include <numbers>

#include "scene/garden_parts.h"
#include "scene/shapes.h"

namespace izb::garden {

using glm::dvec2;
using glm::dvec3;
using shapes::add_ring;
using shapes::add_rod;
using shapes::add_tube;

Mesh wire(const dvec3& a, const dvec3& b, double sag, double radius) {
  constexpr int segments = 48;
  std::vector<dvec3> path;
  for (int i = 0; i <= segments; ++i) path.push_back(on_line(a, b, sag, static_cast<double>(i) / segments));
  Mesh mesh;
  mesh.name = "wire";
  add_tube(mesh, path, radius, 6);
  return mesh;
}

Mesh bulb() {
  Mesh mesh;
  mesh.name = "bulb";
  constexpr std::array profile{dvec2{0, -0.135},     dvec2{0.016, -0.131}, dvec2{0.029, -0.119}, dvec2{0.034, -0.102},
                               dvec2{0.031, -0.085}, dvec2{0.021, -0.064}, dvec2{0.017, -0.050}, dvec2{0.017, -0.050},
                               dvec2{0.017, 0.006},  dvec2{0.017, 0.006},  dvec2{0, 0.006}};
  shapes::add_lathe(mesh, profile, 12);
  return mesh;
}

Mesh cloth(double width, double height, double fold_m, double phase) {
  Mesh mesh;
  mesh.name = "cloth";
  shapes::add_sheet(mesh, 40, 24, [&](double u, double v) {
    // Folds open towards the free lower edge; the sheet sags between its pegs.
    const double x = (u - 0.5) * width, down = 1.0 - v;
    const double fold = fold_m * (0.25 + 0.75 * down);
    const double z = fold * (std::sin(11.0 * u + phase) + 0.5 * std::sin(23.0 * u + 2.0 * phase + 1.5 * down));
    const double peg_sag = 0.02 * std::sin(3.0 * std::numbers::pi * u) * std::sin(3.0 * std::numbers::pi * u);
    return dvec3{x * (1.0 - 0.03 * down), -height * down - peg_sag, z};
  });
  return mesh;
}

namespace {

constexpr double wheel_radius = 0.335, tyre_radius = 0.018, wheelbase = 1.03;
constexpr double axle_height = wheel_radius + tyre_radius - 0.006;  // the tyre is pressed into the floor
constexpr dvec3 rear{0, axle_height, 0}, front{wheelbase, axle_height, 0};

void add_wheel(Mesh& metal, Mesh& rubber, const dvec3& centre) {
  constexpr int spokes = 32;
  constexpr double hub_radius = 0.022, rim_radius = 0.312;
  add_ring(rubber, centre, {0, 0, 1}, wheel_radius, tyre_radius, 72, 12);
  add_ring(metal, centre, {0, 0, 1}, rim_radius, 0.010, 72, 8);
  add_rod(metal, centre - dvec3{0, 0, 0.055}, centre + dvec3{0, 0, 0.055}, 0.012, 12);
  for (const double side : {-1.0, 1.0}) {
    const dvec3 flange = centre + dvec3{0, 0, side * 0.032};
    add_rod(metal, flange - dvec3{0, 0, 0.003}, flange + dvec3{0, 0, 0.003}, 0.026, 16);
  }
  for (int i = 0; i < spokes; ++i) {
    // Crossed lacing: neighbouring spokes leave the hub to either side of their point on the rim.
    const double at_rim = 2.0 * std::numbers::pi * i / spokes;
    const double lead = (i / 2) % 2 == 0 ? 1.0 : -1.0, at_hub = at_rim + lead * 60.0 * degree;
    const double side = (i % 2 == 0 ? 1.0 : -1.0) * (0.032 + 0.002 * lead);  // so that crossing ones pass
    const dvec3 inner = centre + dvec3{hub_radius * std::cos(at_hub), hub_radius * std::sin(at_hub), side};
    const dvec3 outer = centre + dvec3{rim_radius * std::cos(at_rim), rim_radius * std::sin(at_rim), 0};
    add_rod(metal, inner, outer, 0.0013, 5);
  }
}

void add_basket(Mesh& metal, const dvec3& bottom) {
  constexpr double radius = 0.0018;
  const auto corner = [&](double y, double x, double z) {
    const double spread = 1.0 + 0.9 * y;
    return bottom + dvec3{0.12 + (x - 0.12) * spread, y, z * spread};
  };
  constexpr double length = 0.24, half = 0.15, height = 0.22;
  for (const double y : {0.0, 0.073, 0.146, height}) {
    const std::array loop{corner(y, 0, -half), corner(y, length, -half), corner(y, length, half), corner(y, 0, half)};
    for (size_t i = 0; i < 4; ++i) {
      // Two heights, so that the wires' faces do not share a plane where they meet.
      const dvec3 lift{0, i % 2 == 0 ? 0.0 : 0.0009, 0};
      add_rod(metal, loop[i] + lift, loop[(i + 1) % 4] + lift, y == height ? 0.004 : radius, 6);
    }
  }
  for (int i = 0; i <= 10; ++i) {
    const double z = -half + 2.0 * half * i / 10;
    for (const double x : {0.0, length}) add_rod(metal, corner(0, x, z), corner(height, x, z), radius, 6);
    if (i == 0 || i == 10) continue;  // there the hoop is the floor's last wire
    add_rod(metal, corner(0.002, 0, z), corner(0.002, length, z), radius, 6);
  }
  for (int i = 1; i < 8; ++i) {
    const double x = length * i / 8;
    for (const double z : {-half, half}) add_rod(metal, corner(0, x, z), corner(height, x, z), radius, 6);
  }
}

}  // namespace

Bicycle bicycle() {
  Bicycle result;
  auto& [paint, metal, rubber, leather] = result;
  paint.name = "bicycle paint", metal.name = "bicycle metal";
  rubber.name = "bicycle rubber", leather.name = "bicycle leather";
  add_wheel(metal, rubber, rear);
  add_wheel(metal, rubber, front);

  const dvec3 pedals{0.43, 0.285, 0}, seat{0.25, 0.80, 0}, head_top{0.84, 0.86, 0}, head_bottom{0.875, 0.71, 0};
  add_rod(paint, pedals, seat, 0.015, 14);
  add_rod(paint, pedals, glm::mix(head_bottom, head_top, 0.2), 0.018, 14);
  add_rod(paint, glm::mix(pedals, seat, 0.55), glm::mix(head_bottom, head_top, 0.75), 0.015, 14);
  add_rod(paint, head_bottom, head_top, 0.020, 14);
  add_rod(paint, pedals - dvec3{0, 0, 0.036}, pedals + dvec3{0, 0, 0.036}, 0.022, 14);
  for (const double side : {-0.06, 0.06}) {
    const dvec3 out{0, 0, side};
    add_rod(paint, rear + out * 0.85, pedals + out * 0.5, 0.009, 10);
    add_rod(paint, rear + out * 0.85, glm::mix(pedals, seat, 0.85) + out * 0.2, 0.007, 10);
    const std::array fork{head_bottom + dvec3{0, 0.01, side * 0.1}, head_bottom + dvec3{0.008, -0.03, side * 0.8},
                          glm::mix(head_bottom, front, 0.7) + dvec3{-0.005, 0, side * 0.9}, front + out * 0.85};
    add_tube(paint, fork, 0.010, 12);
    const std::array crank{pedals + out * 0.55, pedals + out * 1.1,
                           pedals + out * 1.2 + (side > 0 ? 0.17 : -0.17) * dvec3{0.8, -0.6, 0}};
    add_tube(metal, crank, 0.008, 8);
    shapes::add_box(rubber, crank[2] + dvec3{-0.045, -0.012, side > 0 ? 0.0 : -0.09},
                    crank[2] + dvec3{0.045, 0.012, side > 0 ? 0.09 : 0.0});
    // Mudguard stays and the carrier over the rear wheel.
    add_rod(metal, rear + out, rear + dvec3{-0.13, 0.375, side}, 0.003, 6);
    add_rod(metal, rear + dvec3{-0.30, 0.38, side}, rear + dvec3{0.20, 0.38, side}, 0.005, 8);
  }
  for (int i = 0; i < 5; ++i) {
    const double x = -0.28 + 0.1 * i;
    add_rod(metal, rear + dvec3{x, 0.381, -0.06}, rear + dvec3{x, 0.381, 0.06}, 0.0035, 6);
  }
  add_ring(metal, pedals + dvec3{0, 0, 0.045}, {0, 0, 1}, 0.088, 0.004, 36, 6);
  for (int i = 0; i < 5; ++i) {
    const double angle = 72.0 * degree * i;
    add_rod(metal, pedals + dvec3{0, 0, 0.045}, pedals + dvec3{0.088 * std::cos(angle), 0.088 * std::sin(angle), 0.045},
            0.005, 6);
  }
  // The chain's two straight runs.
  add_rod(metal, pedals + dvec3{-0.02, 0.086, 0.045}, rear + dvec3{0, 0.032, 0.045}, 0.003, 5);
  add_rod(metal, pedals + dvec3{-0.02, -0.086, 0.045}, rear + dvec3{0, -0.032, 0.045}, 0.003, 5);
  add_ring(metal, rear + dvec3{0, 0, 0.045}, {0, 0, 1}, 0.032, 0.003, 24, 6);

  const dvec3 stem = head_top + dvec3{-0.025, 0.12, 0};
  add_tube(metal, std::array{head_top - dvec3{0, 0.02, 0}, stem, stem + dvec3{0.05, 0.012, 0}}, 0.011, 10);
  for (const double side : {-1.0, 1.0}) {
    std::vector<dvec3> bar;
    for (int i = 0; i <= 12; ++i) {
      const double t = i / 12.0;
      bar.push_back(stem + dvec3{0.045 + 0.05 * std::sin(3.0 * t) - 0.26 * t * t, 0.01 + 0.06 * std::sin(1.6 * t),
                                 side * (-0.004 + 0.30 * std::sin(1.45 * t))});
    }
    add_tube(metal, bar, 0.0105, 10);
    add_tube(rubber, std::array{bar[10] + 0.6 * (bar[11] - bar[10]), bar[11], bar[12] + 0.9 * (bar[12] - bar[11])},
             0.0150, 10);
  }
  const std::array saddle{dvec3{0.09, 0.885, 0}, dvec3{0.11, 0.886, 0}, dvec3{0.17, 0.883, 0},
                          dvec3{0.24, 0.879, 0}, dvec3{0.33, 0.876, 0}, dvec3{0.37, 0.870, 0}};
  add_tube(leather, saddle, std::array{0.045, 0.066, 0.070, 0.045, 0.027, 0.012}, 20);
  add_rod(metal, glm::mix(pedals, seat, 0.9), seat + dvec3{-0.02, 0.07, 0}, 0.012, 10);
  // The side stand, on the side to which the bicycle leans.
  add_rod(metal, rear + dvec3{0.10, -0.06, 0.04}, dvec3{0.02, sunk * 0.4, 0.19}, 0.008, 8);
  add_basket(metal, head_top + dvec3{0.06, -0.05, 0});
  return result;
}

}  // namespace izb::garden
