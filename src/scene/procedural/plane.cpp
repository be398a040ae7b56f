// SPDX-License-Identifier: MIT
// A racing airplane of the thirties, after the GeeBee: curved sheets cut into very many small triangles, as a CAD
// system writes them, with slivers along every joint, rivets, fins and spokes. It stands on the apron before its
// hangar.
#include "scene/portable_math.h"
#include "scene/procedural/plane_parts.h"
#include "scene/procedural/scenes.h"

namespace izb::procedural {
namespace {

using glm::dvec2;
using glm::dvec3;

struct Apron {
  Builder& b;
  uint32_t concrete = b.material("concrete", {0.46f, 0.44f, 0.41f});
  uint32_t grass = b.material("grass", {0.20f, 0.25f, 0.10f});
  uint32_t sheet = b.material("corrugated sheet", {0.40f, 0.46f, 0.45f}, true);
  uint32_t frame = b.material("painted steel", {0.30f, 0.11f, 0.08f});
  uint32_t timber = b.material("timber", {0.40f, 0.29f, 0.18f});
  uint32_t drum = b.material("drum", {0.12f, 0.24f, 0.40f});

  // No wider than the picture needs: what is far away makes the texels of a light's grid large.
  void ground() {
    b.pen(grass).triangle({-46, -0.08, 30}, {46, -0.08, 30}, {46, -0.08, -52});
    b.pen(grass).triangle({-46, -0.08, 30}, {46, -0.08, -52}, {-46, -0.08, -52});
    for (int i = 0; i < 9; ++i)
      for (int k = 0; k < 7; ++k)
        if (b.keeps(0.06))
          b.pen(concrete).box({-18.0 + 4.0 * i, -0.3, -14.0 + 4.0 * k},
                              {-14.02 + 4.0 * i, 0.003 * ((i * 5 + k * 3) % 4) - 0.009, -10.02 + 4.0 * k});
  }

  void hangar() {
    const double x0 = -17.0, x1 = 13.0, z = -12.5, h = 5.2, rise = 3.4;
    const int waves = b.rounded(std::min(1.0, 4.0 * b.detail()) * 90, 8), cuts = b.keeps(0.1) ? 6 : 2;
    const auto roof_y = [&](double x) {
      const double t = 2.0 * (x - x0) / (x1 - x0) - 1.0;
      return h + rise * (1.0 - t * t);
    };
    const auto wall = [&](double from, double to, bool open) {
      b.pen(sheet).surface(std::max(1, int(waves * (to - from) / (x1 - x0))) * cuts, 2, {}, [&](double u, double v) {
        const double x = glm::mix(from, to, u), wave = 0.035 * sine(2.0 * std::numbers::pi * x / 0.33);
        return dvec3{x, glm::mix(open ? h - 0.2 : -0.2, roof_y(x), v), z + wave};
      });
    };
    wall(x0, -12.0, false), wall(-12.0, 8.0, true), wall(8.0, x1, false);
    b.pen(sheet).surface(waves, b.rounded(30, 6), {}, [&](double u, double v) {
      const double x = glm::mix(x0 - 0.5, x1 + 0.5, u);
      return dvec3{x, roof_y(std::clamp(x, x0, x1)) + 0.05, glm::mix(z + 0.6, z - 30.0, v)};
    });
    for (const double x : {x0 + 0.05, x1 - 0.05})
      b.pen(sheet).box({x - 0.04, -0.2, z - 29.5}, {x + 0.04, h + 0.04, z - 0.1});
    b.pen(sheet).box({x0, -0.2, z - 29.6}, {x1, h + 0.5, z - 29.5});
    for (int i = 0; i < 5; ++i) {  // bows inside, a door's leaf pushed open
      for (const double x : {x0 + 0.3, x1 - 0.3})
        b.pen(frame).box({x - 0.12, -0.1, z - 1.0 - 6.5 * i - 0.12}, {x + 0.12, h, z - 1.0 - 6.5 * i + 0.12});
      for (int k = 0; k < 16 && b.keeps(0.05); ++k) {
        const double a = glm::mix(x0 + 0.3, x1 - 0.3, k / 16.0), c = glm::mix(x0 + 0.3, x1 - 0.3, (k + 1) / 16.0);
        b.pen(frame).beam({a, roof_y(a) - 0.25, z - 1.0 - 6.5 * i}, {c, roof_y(c) - 0.25, z - 1.0 - 6.5 * i}, 0.12,
                          0.18, {0, 1, 0});
        if (b.keeps(0.1))
          b.pen(frame).beam({a, roof_y(a) - 0.3, z - 1.0 - 6.5 * i}, {0.5 * (a + c), h - 0.1, z - 1.0 - 6.5 * i}, 0.06,
                            0.06, {0, 0, 1});
      }
      b.pen(frame).beam({x0 + 0.3, h - 0.1, z - 1.0 - 6.5 * i}, {x1 - 0.3, h - 0.1, z - 1.0 - 6.5 * i}, 0.1, 0.14,
                        {0, 1, 0});
    }
    for (int i = 0; i < 4; ++i)
      b.pen(sheet).box({8.1 + 0.35 * i, 0.02, z + 0.2 + 0.14 * i}, {11.8 + 0.35 * i, h - 0.3, z + 0.28 + 0.14 * i});
  }

  void props() {
    for (const double z : {-1.02, 1.02})
      for (const double x : {1.43, 0.68}) b.pen(timber).box({x - 0.07, -0.02, z - 0.22}, {x + 0.07, 0.11, z + 0.22});
    const int sides = b.pieces(140, 8);
    for (const dvec3& p : {dvec3{-6.0, 0, -4.2}, dvec3{-5.3, 0, -4.6}, dvec3{-6.1, 0.0, -5.1}}) {
      const std::vector<dvec2> barrel{{0, -0.03},    {0.29, -0.03}, {0.29, -0.03}, {0.29, 0.28},
                                      {0.305, 0.29}, {0.305, 0.31}, {0.29, 0.32},  {0.29, 0.58},
                                      {0.305, 0.59}, {0.305, 0.61}, {0.29, 0.62},  {0.29, 0.88},
                                      {0.29, 0.88},  {0.27, 0.88},  {0.27, 0.86},  {0, 0.86}};
      b.pen(drum, translated(p)).lathe(barrel, sides);
    }
    const glm::dmat4 steps = at({-1.7, 0, 2.0}, 180.0);  // to the cockpit
    for (const double z : {-0.28, 0.28}) {
      b.pen(timber, steps).beam({0.0, -0.02, z}, {0.55, 1.35, z}, 0.05, 0.09, {1, 0, 0});
      b.pen(timber, steps).beam({1.15, -0.02, z}, {0.60, 1.35, z}, 0.04, 0.06, {1, 0, 0});
    }
    for (int i = 1; i < 6; ++i)
      b.pen(timber, steps).box({0.092 * i - 0.09, 0.225 * i, -0.26}, {0.092 * i + 0.09, 0.225 * i + 0.03, 0.26});
    b.pen(drum).box({1.9, -0.02, 2.3}, {2.45, 0.28, 2.6});
    b.pen(frame).rod({1.98, 0.38, 2.45}, {2.37, 0.38, 2.45}, 0.015, b.pieces(40, 4));
    for (const double x : {1.98, 2.37}) b.pen(frame).rod({x, 0.27, 2.45}, {x, 0.385, 2.45}, 0.012, b.pieces(40, 4));
  }
};

}  // namespace

void build_plane(Builder& b) {
  b.set_flat_edge_m(1.0);
  Apron apron{b};
  const PlanePalette palette{b};
  apron.ground();
  apron.hangar();
  apron.props();
  // On its wheels and its skid, the nose up.
  const PlaneParts plane{b, palette, translated({0.0, 1.314, 0.0}) * turned(2, 16.6)};
  plane.fuselage();
  plane.cowl();
  plane.engine();
  plane.propeller();
  plane.wings();
  plane.tail();
  plane.gear();
  plane.cockpit();

  b.camera("main", {{5.6, 1.75, 5.2}, {0.1, 1.25, 0.1}}, 42.0);
  b.camera("engine", {{4.1, 1.9, 1.0}, {2.0, 1.85, 0.0}}, 36.0);
  b.path({{{8.5, 2.6, 7.5}, {0.0, 1.3, 0.0}},
          {{5.4, 1.5, 2.6}, {0.8, 1.5, 0.0}},
          {{3.9, 2.1, -1.2}, {1.2, 1.7, 0.0}},
          {{1.2, 3.0, -5.0}, {-0.6, 1.5, 0.0}},
          {{-4.4, 2.4, -3.4}, {-0.8, 1.4, 0.0}},
          {{-5.2, 2.2, 3.4}, {-0.5, 1.4, 0.0}},
          {{1.0, 3.2, 6.6}, {0.0, 1.2, 0.0}}},
         18.0, true, 46.0);
  b.sun("afternoon sun", 152.0, 33.0, {1.0f, 0.93f, 0.82f}, 3.0f);
}

}  // namespace izb::procedural
