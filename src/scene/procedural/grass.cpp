// SPDX-License-Identifier: MIT
// A meadow seen from low down: thin blades before thin blades, denser towards the camera, with flowers, stones and a
// fence.
#include <algorithm>
#include <vector>

#include "scene/portable_math.h"
#include "scene/procedural/parts.h"
#include "scene/procedural/scenes.h"

namespace izb::procedural {
namespace {

using glm::dvec2;
using glm::dvec3;

constexpr dvec2 stand{0.0, 6.0};  ///< of the main camera: (x, z)

double ground(double x, double z) {
  const double hill = 2.2 * smooth_step(-4.0, -30.0, z) + 1.2 * smooth_step(10.0, 34.0, std::abs(x));
  return hill + 0.22 * fractal_noise({0.22 * x, 0.4, 0.22 * z}, 3, 7);
}

void add_flower(const Pen& stem, const Pen& petals, const Pen& heart, Random& random, int count) {
  const double height = random.between(0.22, 0.46), lean = random.between(-0.12, 0.12);
  const dvec3 top{lean, height, 0.3 * lean};
  stem.hair(std::array{dvec3{0, -0.02, 0}, dvec3{0.2 * lean, 0.5 * height, 0}, top + dvec3{0, 0.006, 0}}, 0.0022, 3);
  const double petal = random.between(0.018, 0.026);
  for (int i = 0; i < count; ++i) {
    const dvec2 on = on_circle(2.0 * std::numbers::pi * i / count + lean),
                next = on_circle(2.0 * std::numbers::pi * (i + 0.7) / count + lean);
    const dvec3 a = top + dvec3{0.006 * on.x, 0.003, 0.006 * on.y}, c = top + petal * dvec3{on.x, 0.25, on.y},
                d = top + petal * dvec3{next.x, 0.28, next.y};
    petals.triangle(a, d, c);
  }
  heart.ball(top + dvec3{0, 0.004, 0}, 0.008, 6);
}

void add_stone(const Pen& pen, uint32_t seed, double size, int sides) {
  pen.surface(
      sides, std::max(3, sides / 2), {.wrap_u = true, .pole_begin = true, .pole_end = true}, [&](double u, double v) {
        const dvec2 around = on_circle(2.0 * std::numbers::pi * u), up = on_circle(std::numbers::pi * v);
        const dvec3 p{up.y * around.x, -up.x, -up.y * around.y};
        const double r = size * (1.0 + 0.30 * noise(1.3 * p + 9.0, seed) + 0.12 * noise(3.1 * p + 9.0, seed + 1));
        return dvec3{1.25, 0.72, 1.0} * p * r;
      });
}

struct Fence {
  Builder& b;
  Pen pen;

  void run(const dvec2& from, const dvec2& to, int bays) const {
    for (int i = 0; i <= bays; ++i) {
      const dvec2 p = glm::mix(from, to, double(i) / bays);
      const double y = ground(p.x, p.y);
      pen.in(at({p.x, y, p.y}, 7.0 * i))
          .tube(std::array{dvec3{0, -0.4, 0}, dvec3{0.012, 0.6, 0}, dvec3{0, 1.16, 0.01}, dvec3{0, 1.2, 0.01}},
                std::array{0.062, 0.060, 0.055, 0.035}, b.pieces(12, 4));
      if (i == bays) break;
      const dvec2 q = glm::mix(from, to, double(i + 1) / bays);
      for (const double h : {0.42, 0.74, 1.04}) {
        const double sag = 0.015 * ((i * 7 + int(10 * h)) % 3);
        pen.beam({p.x, y + h, p.y}, {q.x, ground(q.x, q.y) + h - sag, q.y}, 0.03, 0.09, {0, 1, 0});
      }
    }
  }
};

}  // namespace

void build_grass(Builder& b) {
  const uint32_t soil = b.material("soil", {0.13f, 0.13f, 0.055f});
  const uint32_t greens[]{b.material("grass", {0.15f, 0.25f, 0.06f}, true),
                          b.material("pale grass", {0.25f, 0.31f, 0.10f}, true),
                          b.material("dry grass", {0.38f, 0.34f, 0.17f}, true)};
  const uint32_t white = b.material("petals", {0.84f, 0.82f, 0.76f}, true),
                 yellow = b.material("heart", {0.78f, 0.55f, 0.08f});
  const uint32_t stone = b.material("stone", {0.36f, 0.34f, 0.31f}),
                 wood = b.material("weathered wood", {0.33f, 0.27f, 0.21f});

  const int cuts = b.pieces(90, 10);
  b.pen(soil).surface(cuts, cuts, {}, [](double u, double v) {
    const double x = 90.0 * (u - 0.5), z = 14.0 - 74.0 * v;
    return dvec3{x, ground(x, z), z};
  });

  // A quarter of the finer detail goes into more pieces a blade, the rest into more blades.
  const int blades = b.rounded(186000.0 * b.detail() * std::sqrt(b.detail()), 60);
  const double levels = 3.0 * std::sqrt(b.detail());
  const double wide = 1.0 / std::sqrt(std::clamp(b.detail(), 0.05, 1.5));
  const Pen pens[]{b.pen(greens[0]), b.pen(greens[1]), b.pen(greens[2])};
  Random random = b.random(1);
  for (int i = 0; i < blades; ++i) {
    const int cut = b.rounded(levels, 2);
    if (b.counting()) {
      b.add_count(size_t(2 * cut - 1));
      continue;
    }
    // Blades stand the denser, the nearer they are to the camera, and are the wider the further away.
    const double t = random.between(0.0, 1.0), distance = 0.9 + 34.0 * t * t * t + 7.0 * t,
                 turn = random.between(-0.98, 0.98);
    const dvec2 on = on_circle(turn);
    const double x = stand.x + distance * on.y, z = stand.y + 1.2 - distance * on.x;
    const double clump = noise({0.9 * x, 0.0, 0.9 * z}, 21), dry = noise({0.35 * x, 0.5, 0.35 * z}, 22);
    const double r = random.between(0.0, 1.0), height = (0.10 + 0.26 * r * r) * (1.0 + 0.45 * clump);
    const double width = random.between(0.0035, 0.0065) * wide * (1.0 + 0.10 * distance),
                 facing = random.between(0.0, 6.2832);
    const double bend = random.between(0.15, 0.95), pick = random.between(-0.6, 0.9);
    add_blade(pens[pick < dry          ? 2
                   : pick < dry + 0.55 ? 1
                                       : 0],
              {x, ground(x, z) - 0.02, z}, height, width, facing, bend, cut);
  }
  const int flowers = b.rounded(420 * std::min(2.0, b.detail()), 4);
  for (int i = 0; i < flowers; ++i) {
    Random mine = b.random(100 + uint64_t(i));
    const double t = mine.between(0.0, 1.0), distance = 1.3 + 16.0 * t * t;
    const dvec2 on = on_circle(mine.between(-0.8, 0.8));
    const double x = stand.x + distance * on.y, z = stand.y + 1.0 - distance * on.x;
    const glm::dmat4 place = at({x, ground(x, z), z}, mine.between(0, 360));
    add_flower(b.pen(greens[0], place), b.pen(white, place), b.pen(yellow, place), mine, b.pieces(12, 5));
  }
  for (int i = 0; i < 9; ++i) {
    Random mine = b.random(50 + uint64_t(i));
    const double x = mine.between(-5.0, 6.5), z = mine.between(-6.0, 3.4), size = mine.between(0.10, 0.34);
    add_stone(b.pen(stone, at({x, ground(x, z) + 0.2 * size, z}, mine.between(0, 360))), uint32_t(i) + 3, size,
              b.pieces(36, 6));
  }
  Fence{b, b.pen(wood)}.run({-9.0, -2.6}, {1.6, -1.0}, b.detail() < 0.2 ? 3 : 5);
  Fence{b, b.pen(wood)}.run({4.0, -0.6}, {13.0, -3.4}, b.detail() < 0.2 ? 3 : 4);

  b.camera("main", {{stand.x, ground(stand.x, stand.y) + 0.62, stand.y}, {0.5, 0.30, 0.0}}, 48.0);
  b.camera("low", {{0.3, ground(0.3, 4.6) + 0.22, 4.6}, {0.2, 0.2, 1.0}}, 50.0);
  b.path({{{0.0, 0.75, 6.0}, {0.5, 0.3, 0.0}},
          {{-1.4, 0.55, 3.8}, {0.0, 0.35, -1.0}},
          {{-0.4, 0.62, 2.0}, {1.2, 0.5, -2.0}},
          {{2.2, 0.95, 1.8}, {-1.0, 0.5, -2.0}},
          {{2.6, 1.6, 4.8}, {-0.5, 0.2, 0.0}}},
         16.0, true, 50.0);
  b.sun("evening sun", 246.0, 21.0, {1.0f, 0.84f, 0.60f}, 3.2f);
}

}  // namespace izb::procedural
