// SPDX-License-Identifier: MIT
// A ball of long curled threads, after Laine and Karras's hairball: thin parts in many layers, nearly every one in the
// shadow of others.
#include <algorithm>
#include <vector>

#include "scene/portable_math.h"
#include "scene/procedural/parts.h"
#include "scene/procedural/scenes.h"

namespace izb::procedural {
namespace {

using glm::dvec2;
using glm::dvec3;

constexpr double ball_radius = 1.0;
constexpr dvec3 centre{0.0, 1.52, 0.0};

/// A thread that leaves the core, curls through a layer and comes out at the surface.
std::vector<dvec3> thread(Random random, int segments) {
  const double height = random.between(-1.0, 1.0), turn = random.between(0.0, 2.0 * std::numbers::pi);
  const dvec2 on = on_circle(turn);
  const double level = std::sqrt(1.0 - height * height);
  dvec3 p = 0.18 * ball_radius * dvec3{level * on.x, height, level * on.y};
  dvec3 heading = glm::normalize(p);
  const double depth = random.between(0.0, 1.0);
  const double reach = (1.0 - 0.55 * depth * depth) * 0.97 * ball_radius, length = random.between(3.2, 4.4);
  const double curl = random.between(9.0, 16.0), phase = random.between(0.0, 6.28);
  // Many short steps, whatever the number of segments, so that detail does not change the thread's way.
  constexpr int steps = 240;
  const double step = length / steps;
  std::vector<dvec3> way{p};
  for (int i = 1; i <= steps; ++i) {
    const double t = double(i) / steps, r = glm::length(p);
    const dvec3 out = p / r, q = 2.7 * p + dvec3{5.0 + 3.0 * phase};
    const dvec3 drift{noise(q, 1), noise(q, 2), noise(q, 3)};
    const double wanted = t < 0.85 ? reach * std::min(1.0, 3.2 * t + 0.2) : ball_radius;
    const dvec3 side = across(heading), other = glm::cross(heading, side);
    const dvec2 twist = on_circle(curl * t * 6.28 + phase);
    heading = glm::normalize(heading + 0.08 * drift + 0.11 * (twist.x * side + twist.y * other) +
                             std::clamp(1.6 * (wanted - r), -0.30, 0.12) * out);
    p += step * heading;
    way.push_back(p);
  }
  std::vector<dvec3> path;
  for (int k = 0; k <= segments; ++k) {
    const double at = double(steps) * k / segments;
    const size_t i = std::min(size_t(at), size_t(steps - 1));
    path.push_back(glm::mix(way[i], way[i + 1], at - double(i)));
  }
  return path;
}

}  // namespace

void build_hairball(Builder& b) {
  const uint32_t hair = b.material("hair", {0.70f, 0.49f, 0.30f});
  const uint32_t plinth = b.material("plinth", {0.55f, 0.54f, 0.52f});
  const uint32_t ground = b.material("ground", {0.42f, 0.41f, 0.40f});
  b.set_flat_edge_m(4.0);

  const double root = std::sqrt(b.detail());
  const int threads = b.rounded(2050.0 * b.detail(), 24);
  const double segments = 175.0 * root, sides = 4.0 * root;
  // Fewer threads are thicker, so that the ball keeps its body.
  const double radius = 0.0046 / std::sqrt(std::max(0.02, std::min(b.detail(), 2.0)));
  const Pen pen = b.pen(hair, translated(centre));
  for (int i = 0; i < threads; ++i) {
    const int n = b.rounded(segments, 24), around = b.rounded(sides, 3);
    if (b.counting())
      b.add_count(size_t(around) * (2 * size_t(n) - 1));
    else
      pen.hair(thread(b.random(uint64_t(i) + 1), n), radius, around);
  }
  const int round = b.pieces(96, 16);
  const std::vector<dvec2> stand{{0, -0.05},   {0.8, -0.05}, {0.8, -0.05},  {0.8, 0.05},  {0.77, 0.08}, {0.77, 0.08},
                                 {0.62, 0.08}, {0.62, 0.08}, {0.55, 0.14},  {0.55, 0.48}, {0.60, 0.52}, {0.60, 0.56},
                                 {0.60, 0.56}, {0.52, 0.56}, {0.42, 0.545}, {0, 0.535}};
  b.pen(plinth).lathe(stand, round);
  b.pen(ground).box({-9.0, -0.4, -9.0}, {9.0, 0.0, 8.0});

  b.camera("main", {{1.9, 2.05, 4.6}, {0.12, 1.22, 0.0}}, 37.0);
  b.camera("near", {{0.55, 1.95, 1.75}, {0.0, 1.6, 0.0}}, 40.0);
  b.path({{{1.9, 2.05, 4.6}, {0.1, 1.3, 0.0}},
          {{-1.2, 1.6, 3.3}, {0.0, 1.5, 0.0}},
          {{-0.9, 1.9, 1.45}, {0.0, 1.55, 0.0}},
          {{0.9, 2.3, 1.5}, {0.0, 1.5, 0.0}},
          {{3.4, 2.6, 2.4}, {0.0, 1.3, 0.0}}},
         15.0, true, 40.0);
  b.sun("key light", 238.0, 38.0, {1.0f, 0.95f, 0.88f}, 3.0f);
}

}  // namespace izb::procedural
