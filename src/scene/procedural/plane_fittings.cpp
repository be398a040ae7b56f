// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <vector>

#include "scene/portable_math.h"
#include "scene/procedural/plane_parts.h"

namespace izb::procedural {

using glm::dmat4;
using glm::dvec2;
using glm::dvec3;

namespace {

constexpr double pi = std::numbers::pi;
constexpr dvec3 forward{1, 0, 0};

}  // namespace

void PlaneParts::cylinder(const dmat4& place) const {
  const Pen fins = pen(p_.dark).in(place), head = pen(p_.metal).in(place);
  std::vector<dvec2> profile{{0, 0.20}};
  const int count = b_.rounded(26 * std::min(1.0, 0.02 + b_.detail()), 1);
  for (int i = 0; i < count; ++i) {
    const double y = 0.21 + 0.25 * i / count, t = 0.25 / count,
                 r = 0.068 + 0.022 * smooth_step(0.0, 0.6, double(i) / count);
    for (const dvec2& q : {dvec2{0.052, y}, dvec2{r, y + 0.30 * t}, dvec2{r + 0.001, y + 0.38 * t},
                           dvec2{r, y + 0.46 * t}, dvec2{0.052, y + 0.76 * t}})
      profile.push_back(q);
  }
  profile.push_back({0.06, 0.465}), profile.push_back({0.045, 0.50}), profile.push_back({0, 0.505});
  const int sides = b_.pieces(90, 6);
  fins.lathe(profile, sides);
  if (!b_.keeps(0.05)) return;
  for (const double z : {-0.045, 0.045}) {  // rocker boxes, push rods, a plug
    head.ball({0.0, 0.50, z}, 0.032, b_.pieces(40, 5));
    head.rod({0.075, 0.10, 0.5 * z}, {0.07, 0.49, z}, 0.009, b_.pieces(24, 4));
  }
  pen(p_.brass).in(place).rod({0.03, 0.44, 0.0}, {0.13, 0.47, 0.0}, 0.011, b_.pieces(20, 4));
}

void PlaneParts::engine() const {
  const Pen shaft = pen(p_.metal).in(along({0, 0, 0}, forward));
  shaft.lathe(std::array{dvec2{0, 1.50}, dvec2{0.23, 1.50}, dvec2{0.23, 1.50}, dvec2{0.24, 1.90}, dvec2{0.21, 1.97},
                         dvec2{0.14, 2.02}, dvec2{0.12, 2.12}, dvec2{0.085, 2.16}, dvec2{0.085, 2.32}, dvec2{0, 2.32}},
              b_.pieces(260, 8));
  for (int i = 0; i < 9; ++i) cylinder(translated({1.76, 0, 0}) * turned(0, 40.0 * i));
  for (int i = 0; i < 9 && b_.keeps(0.1); ++i) {  // exhaust stubs
    const dmat4 turn = translated({1.76, 0, 0}) * turned(0, 40.0 * i + 14.0);
    const dvec3 root{-0.02, 0.42, 0};
    pen(p_.brass).in(turn).tube(
        std::array{root, root + dvec3{-0.08, 0.05, 0}, root + dvec3{-0.20, 0.03, 0}, root + dvec3{-0.30, -0.02, 0}},
        0.024, b_.pieces(40, 5));
  }
  for (int i = 0; i < 18 && b_.keeps(0.3); ++i) {
    const dvec2 on = on_circle(2.0 * pi * i / 18);
    pen(p_.brass).rod({1.95, 0.195 * on.x, 0.195 * on.y}, {1.995, 0.195 * on.x, 0.195 * on.y}, 0.009, 6);
  }
  oriented(pen(p_.dark), b_.pieces(120, 8), b_.pieces(40, 2), {.wrap_u = true},
           [](double u, double v) {
             const dvec2 on = on_circle(2.0 * pi * u);
             return dvec3{1.50, glm::mix(0.22, 0.76, v) * on.x, glm::mix(0.22, 0.76, v) * on.y};
           },
           {0.5, 0, 0});
}

void PlaneParts::propeller() const {
  // Wherever the engine stopped.
  const double stopped_at_deg = 24.0 + b_.random(7).between(-16.0, 16.0);
  for (const double side : {0.0, 180.0}) {
    const Pen blade = pen(p_.metal).in(translated({2.36, 0, 0}) * turned(0, stopped_at_deg + side));
    oriented(blade, b_.pieces(190, 6), b_.pieces(420, 5), {.wrap_u = true, .pole_end = true},
             [](double u, double v) {
               const double r = 0.05 + 1.20 * v, root = smooth_step(0.0, 0.22, v);
               const double chord = glm::mix(0.05, 0.15 * (1.0 - 0.55 * v), root) *
                                    std::sqrt(std::max(0.0, 1.0 - v * v * v * v * v * v)),
                            thick = glm::mix(0.05, 0.018 * (1.1 - v), root) *
                                    std::sqrt(std::max(0.0, 1.0 - v * v * v * v * v * v));
               const dvec2 on = on_circle(2.0 * pi * u), twist = on_circle(glm::mix(62.0, 16.0, std::sqrt(v)) * degree);
               const double a = chord * on.x, c = thick * on.y;
               return dvec3{a * twist.y + c * twist.x, r, a * twist.x - c * twist.y};
             },
             {0, 0.6, 0});
  }
  std::vector<dvec2> spinner{{0, 2.26}, {0.13, 2.26}, {0.13, 2.26}};
  const int cuts = b_.pieces(70, 4);
  for (int i = 0; i < cuts; ++i) {
    const dvec2 on = on_circle(0.5 * pi * i / cuts);
    spinner.push_back({0.13 * on.x, 2.40 + 0.22 * on.y});
  }
  spinner.push_back({0, 2.62});
  pen(p_.metal).in(along({0, 0, 0}, forward)).lathe(spinner, b_.pieces(260, 8));
}

void PlaneParts::gear() const {
  for (const bool left : {false, true}) {
    const dvec3 hub{0.72, -1.16, 1.02};
    // The pant: a drop around the wheel, open below.
    const Sheet pant = [=](double u, double v) {
      const double t = 0.003 + 0.994 * u, x = glm::mix(0.48, -0.86, t);
      const double r =
          5.0 * (0.2969 * std::sqrt(t) - 0.1260 * t - 0.3516 * t * t + 0.2843 * t * t * t - 0.1036 * t * t * t * t);
      const dvec2 on = on_circle(2.0 * pi * v);
      const double below = on.x < -0.72 ? -0.72 : on.x;
      return hub + dvec3{x, 0.03 + 0.66 * r * below, 0.36 * r * on.y * (on.x < -0.72 ? 0.96 : 1.0)};
    };
    for (int k = 0; k < 6; ++k) {
      const Sheet part = [&](double u, double v) { return pant(u, (k + v) / 6.0); };
      trimmed(pen(k % 3 == 0 ? p_.red : p_.white, left), 190, 90, part, hub - dvec3{0.2, 0, 0});
      rivets(pen(p_.red, left), part, hub - dvec3{0.2, 0, 0}, {0.05, 0.05}, {0.95, 0.05}, 0.02);
    }
    pen(p_.rubber, left).ring(hub - dvec3{0, 0.10, 0}, {0, 0, 1}, 0.245, 0.070, b_.pieces(260, 12), b_.pieces(110, 5));
    pen(p_.metal, left)
        .in(along(hub - dvec3{0, 0.10, 0.05}, {0, 0, 1}))
        .lathe(std::array{dvec2{0, 0}, dvec2{0.17, 0}, dvec2{0.19, 0.02}, dvec2{0.19, 0.08}, dvec2{0.17, 0.10},
                          dvec2{0, 0.10}},
               b_.pieces(150, 8));
    // A faired leg to the wing's root.
    oriented(
        pen(p_.red, left), b_.pieces(120, 6), b_.pieces(260, 3), {.wrap_u = true},
        [=](double u, double v) {
          const dvec3 top{0.42, -0.30, 0.86}, bottom = hub + dvec3{-0.08, 0.16, 0};
          const dvec2 on = on_circle(2.0 * pi * u);
          const double flare = 1.0 + 0.9 * smooth_step(0.7, 1.0, v) + 0.5 * smooth_step(0.25, 0.0, v);
          return glm::mix(bottom, top, v) + dvec3{0.24 * on.x - 0.08, 0, 0.045 * flare * on.y * (1.15 - 0.5 * on.x)};
        },
        {0.4, -0.7, 0.94});
  }
}

void PlaneParts::cockpit() const {
  const double low = 0.42;
  const auto hoop = [&](double t, double lift) {
    std::vector<dvec3> path;
    for (int i = 0; i <= 24; ++i) {
      const double turn = -0.62 + 1.24 * i / 24;
      const dvec3 p = plane_body(t, turn), axis{p.x, 0.1, 0};
      path.push_back(axis + (p - axis) * (1.0 + lift * (1.0 - (turn / 0.64) * (turn / 0.64))));
    }
    return path;
  };
  const std::array hoops{hoop(0.555, 0.04), hoop(0.60, 0.42), hoop(0.66, 0.52), hoop(0.72, 0.44), hoop(0.775, 0.10)};
  if (!b_.keeps(0.04)) return;
  for (const auto& path : hoops) pen(p_.metal).tube(path, 0.011, b_.pieces(26, 4));
  for (const size_t k : {4u, 9u, 12u, 15u, 20u}) {
    std::vector<dvec3> rail;
    for (const auto& path : hoops) rail.push_back(path[k]);
    pen(p_.metal).tube(rail, 0.008, b_.pieces(26, 4));
  }
  const double x = -1.62;
  pen(p_.leather).box({x - 0.06, low - 0.34, -0.21}, {x + 0.38, low - 0.26, 0.21});
  pen(p_.leather)
      .hexahedron({dvec3{x - 0.12, low - 0.3, 0.21}, dvec3{x - 0.04, low - 0.3, 0.21},
                   dvec3{x - 0.04, low - 0.3, -0.21}, dvec3{x - 0.12, low - 0.3, -0.21}},
                  {dvec3{x - 0.22, low + 0.26, 0.19}, dvec3{x - 0.14, low + 0.26, 0.19},
                   dvec3{x - 0.14, low + 0.26, -0.19}, dvec3{x - 0.22, low + 0.26, -0.19}});
  pen(p_.dark).rod({x + 0.45, low - 0.45, 0}, {x + 0.40, low + 0.05, 0}, 0.013, b_.pieces(30, 4));
  pen(p_.rubber).ball({x + 0.40, low + 0.06, 0}, 0.028, b_.pieces(40, 5));
  pen(p_.wood).box({x + 0.70, low - 0.22, -0.30}, {x + 0.73, low + 0.13, 0.30});
  for (int i = 0; i < 6 && b_.keeps(0.05); ++i) {
    const dvec3 dial{x + 0.70, low - 0.08 + 0.12 * (i / 3), -0.17 + 0.17 * (i % 3)};
    pen(p_.brass).ring(dial, forward, 0.055, 0.008, b_.pieces(70, 6), b_.pieces(18, 3));
    pen(p_.white).rod(dial - dvec3{0.002, 0, 0}, dial + dvec3{0.01, 0, 0}, 0.05, b_.pieces(70, 6));
  }
}

}  // namespace izb::procedural
