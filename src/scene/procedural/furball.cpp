// SPDX-License-Identifier: MIT
// The scene of Lefohn, Sengupta and Owens (2007): 4000 hairs of 12 segments on a ball before a wall. Small receivers
// without coherence on the one side, their shadow on a large plain one.
#include <algorithm>
#include <array>
#include <vector>

#include "scene/portable_math.h"
#include "scene/procedural/parts.h"
#include "scene/procedural/scenes.h"

namespace izb::procedural {
namespace {

using glm::dvec2;
using glm::dvec3;

constexpr int hairs = 4000, segments = 12;
constexpr double skin_radius = 0.55;
constexpr dvec3 centre{0.0, 1.35, 0.0};

std::array<dvec3, segments + 1> hair(Random random, int i) {
  // Points spread evenly over the sphere: the golden angle from pole to pole.
  const double y = 1.0 - 2.0 * (i + 0.5) / hairs, level = std::sqrt(1.0 - y * y);
  const dvec2 on = on_circle(2.399963229728653 * i + random.between(-0.02, 0.02));
  const dvec3 out{level * on.x, y, level * on.y};
  const double length = random.between(0.42, 0.60);
  const dvec3 side = across(out), other = glm::cross(out, side);
  const dvec3 lock{noise(3.0 * out + 4.0, 1), noise(3.0 * out + 4.0, 2), noise(3.0 * out + 4.0, 3)};
  const double lean_x = random.between(-0.25, 0.25), lean_y = random.between(-0.25, 0.25);
  dvec3 heading = glm::normalize(out + 0.30 * lock + lean_x * side + lean_y * other);
  std::array<dvec3, segments + 1> path;
  path[0] = centre + (skin_radius - 0.01) * out;
  for (int k = 1; k <= segments; ++k) {
    path[size_t(k)] = path[size_t(k) - 1] + heading * (length / segments);
    heading = glm::normalize(heading + dvec3{0.0, -0.055, 0.0} + 0.06 * lock);
    const dvec3 from_centre = path[size_t(k)] - centre;
    const double r = glm::length(from_centre);
    if (r < skin_radius + 0.02) path[size_t(k)] = centre + from_centre * ((skin_radius + 0.02) / r);
  }
  return path;
}

/// A hair without thickness: two triangles a segment, one at the tip.
void add_ribbon(const Pen& pen, const std::array<dvec3, segments + 1>& path, double width) {
  const dvec3 out = glm::normalize(path[0] - centre), side = across(out);
  pen.surface(1, segments, {.pole_end = true}, [&](double u, double v) {
    const size_t k = size_t(v * segments + 0.5);
    return path[k] + side * (width * (u - 0.5) * (1.0 - 0.8 * v * v));
  });
}

}  // namespace

void build_furball(Builder& b) {
  const uint32_t fur = b.material("fur", {0.52f, 0.34f, 0.18f}, true);
  const uint32_t skin = b.material("skin", {0.17f, 0.11f, 0.07f});
  const uint32_t wall = b.material("wall", {0.60f, 0.58f, 0.54f});
  const uint32_t floor = b.material("floor", {0.40f, 0.33f, 0.26f});
  b.set_flat_edge_m(2.0);

  // At detail 1 each hair is a tube of three sides; below, more and more are ribbons, then there are fewer of them.
  const double share = std::min(1.0, 2.9 * b.detail() * b.detail());
  const double sides = b.detail() < 1.0 ? 3.0 - 4.0 * (1.0 - b.detail()) : 3.0 * b.detail() * b.detail();
  const double radius = 0.0030 / std::sqrt(std::max(0.1, share));
  for (int i = 0; i < hairs; ++i) {
    const int around = b.rounded(sides, 1);
    if (share < 1.0 && !(share > double((i * 2531) % hairs) / hairs)) continue;
    const Pen pen = b.pen(fur);
    if (b.counting())
      b.add_count(size_t(around < 3 ? 1 : around) * (2 * segments - 1));
    else if (around < 3)
      add_ribbon(pen, hair(b.random(uint64_t(i) + 1), i), 2.2 * radius);
    else
      pen.hair(hair(b.random(uint64_t(i) + 1), i), radius, around);
  }
  b.pen(skin).ball(centre, skin_radius, b.pieces(64, 16));
  b.pen(wall).box({-12.0, -0.3, -2.6}, {12.0, 6.0, -2.3});
  b.pen(wall).box({-12.03, -0.28, -2.35}, {12.03, 0.12, -2.275});
  const int boards = b.rounded(34 * std::min(1.0, b.detail()), 4);
  for (int i = 0; i < boards; ++i) {
    const double z = -2.28 + 9.0 * i / boards;
    b.pen(floor).box({-12.0, -0.1, z}, {12.0, 0.002 * (i % 3), z + 9.0 / boards - 0.006});
  }
  const std::vector<dvec2> stand{{0, -0.02},   {0.42, -0.02}, {0.42, -0.02}, {0.42, 0.03}, {0.40, 0.05},
                                 {0.06, 0.08}, {0.035, 0.14}, {0.03, 0.80},  {0, 0.80}};
  b.pen(floor, translated({0, 0.01, 0})).lathe(stand, b.pieces(40, 8));

  b.camera("main", {{-0.55, 1.7, 3.9}, {0.62, 1.25, -0.7}}, 45.0);
  b.camera("wall", {{1.35, 1.6, 1.5}, {1.95, 0.95, -2.3}}, 48.0);
  b.camera("fur", {{0.75, 1.7, 1.9}, {0.0, 1.38, 0.0}}, 40.0);
  b.path({{{-0.55, 1.7, 3.9}, {0.6, 1.25, -0.7}},
          {{0.8, 1.7, 1.9}, {0.0, 1.35, 0.0}},
          {{-1.5, 1.3, 1.6}, {0.0, 1.35, -0.3}},
          {{-2.2, 2.3, 2.4}, {-0.2, 1.2, -1.0}},
          {{0.4, 2.9, 3.0}, {-0.3, 1.2, -0.8}}},
         14.0, true, 46.0);
  b.sun("lamp", 237.0, 22.0, {1.0f, 0.94f, 0.84f}, 3.0f);
}

}  // namespace izb::procedural
