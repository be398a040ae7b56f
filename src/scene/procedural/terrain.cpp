// SPDX-License-Identifier: MIT
// Mountains cut by water under a low sun: one large surface that shadows itself at every scale, and woods in the
// valleys.
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

constexpr double side_m = 6000.0;

/// Heights on a square grid, eroded by drops of water that each run downhill, carry soil off where they are fast and
/// leave it where they are slow.
class Relief {
 public:
  explicit Relief(uint32_t seed) : random_(seed * 77ull + 5), seed_(seed), height_(size_t(n) * n) {
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) at(i, j) = uplift(double(i) / (n - 1), double(j) / (n - 1));
    for (int i = 0; i < drops; ++i) run_drop();
  }

  /// In metres; x and z from the centre.
  double height(double x, double z) const {
    const double u = std::clamp(x / side_m + 0.5, 0.0, 1.0) * (n - 1),
                 v = std::clamp(z / side_m + 0.5, 0.0, 1.0) * (n - 1);
    const int i = std::min(int(u), n - 2), j = std::min(int(v), n - 2);
    const auto row = [&](int k) {
      return spline(sample(i - 1, k), sample(i, k), sample(i + 1, k), sample(i + 2, k), u - i);
    };
    const double smooth = spline(row(j - 1), row(j), row(j + 1), row(j + 2), v - j);
    const double high = smooth_step(150.0, 900.0, smooth);
    return smooth + (2.0 + 22.0 * high) * fractal_noise({x / 70.0, 0.7, z / 70.0}, 4, seed_ + 40);
  }

 private:
  static constexpr int n = 400, drops = 90000;

  double uplift(double u, double v) const {
    const dvec3 p{3.1 * u, 0.37, 3.1 * v};
    const dvec3 bent =
        p + 0.35 * dvec3{fractal_noise(p + 7.1, 4, seed_ + 20), 0.0, fractal_noise(p + 3.7, 4, seed_ + 30)};
    double sum = 0.0, size = 0.55, weight = 1.0, scale = 1.0;
    for (uint32_t k = 0; k < 7; ++k) {  // ridges, finer ones where the coarser are high
      const double crest = 1.0 - std::abs(noise(bent * scale + 11.0 * k, seed_ + k));
      sum += size * weight * crest * crest;
      weight = std::clamp(1.6 * crest * crest * weight, 0.0, 1.0);
      size *= 0.5, scale *= 2.05;
    }
    const double valley =
        smooth_step(0.02, 0.42, std::abs(u - 0.47 - 0.10 * noise({2.0 * v, 0, 0.3}, seed_ + 50)) + 0.10 * (1.0 - v));
    return 1500.0 * sum * (0.12 + 0.88 * valley);
  }

  double& at(int i, int j) { return height_[size_t(j) * n + size_t(i)]; }
  double sample(int i, int j) const {
    return height_[size_t(std::clamp(j, 0, n - 1)) * n + size_t(std::clamp(i, 0, n - 1))];
  }
  static double spline(double a, double b, double c, double d, double t) {
    return b + 0.5 * t * (c - a + t * (2.0 * a - 5.0 * b + 4.0 * c - d + t * (3.0 * (b - c) + d - a)));
  }

  struct Slope {
    double height;
    dvec2 uphill;
  };
  Slope slope(const dvec2& p) const {
    const int i = int(p.x), j = int(p.y);
    const double x = p.x - i, y = p.y - j, a = sample(i, j), c = sample(i + 1, j), d = sample(i, j + 1),
                 e = sample(i + 1, j + 1);
    return {glm::mix(glm::mix(a, c, x), glm::mix(d, e, x), y), {glm::mix(c - a, e - d, y), glm::mix(d - a, e - c, x)}};
  }
  void deposit(const dvec2& p, double amount) {
    const int i = int(p.x), j = int(p.y);
    const double x = p.x - i, y = p.y - j;
    at(i, j) += amount * (1 - x) * (1 - y), at(i + 1, j) += amount * x * (1 - y);
    at(i, j + 1) += amount * (1 - x) * y, at(i + 1, j + 1) += amount * x * y;
  }

  void run_drop() {
    const double x = random_.between(2, n - 3);
    dvec2 p{x, random_.between(2, n - 3)}, heading{0.0};
    double speed = 1.0, water = 1.0, soil = 0.0;
    for (int step = 0; step < 48; ++step) {
      const Slope here = slope(p);
      heading = 0.25 * heading - 0.75 * here.uphill;
      const double length = glm::length(heading);
      if (length < 1e-9) return;
      heading /= length;
      const dvec2 next = p + heading;
      if (next.x < 1 || next.y < 1 || next.x >= n - 2 || next.y >= n - 2) return;
      const double fall = here.height - slope(next).height;
      const double carries = std::max(fall, 0.05) * speed * water * 0.9;
      if (fall < 0.0 || soil > carries) {
        const double drop = fall < 0.0 ? std::min(-fall, soil) : 0.3 * (soil - carries);
        soil -= drop, deposit(p, drop);
      } else {
        const double take = std::min(0.25 * (carries - soil), 0.8 * fall);
        soil += take, deposit(p, -take);
      }
      speed = std::sqrt(std::clamp(speed * speed + 0.02 * fall, 0.05, 6.0));
      water *= 0.975;
      p = next;
    }
  }

  Random random_;
  uint32_t seed_;
  std::vector<double> height_;
};

enum Ground { meadow, scree, rock, snow, ground_count };

Ground ground_of(const dvec3& p, const dvec3& normal, double wobble) {
  const double y = p.y + 160.0 * wobble;
  if (normal.y < 0.62) return rock;
  if (y > 900.0 && normal.y > 0.70) return snow;
  if (y > 560.0) return normal.y > 0.82 ? scree : rock;
  return normal.y > 0.76 ? meadow : scree;
}

/// The surface as one mesh a kind of ground; meshes share their borders' positions.
void add_surface(Builder& b, const Relief& relief, const std::array<uint32_t, ground_count>& materials, int cuts) {
  const size_t row = size_t(cuts) + 1;
  std::vector<dvec3> points(row * row), normals(row * row, dvec3{0.0});
  for (size_t j = 0; j < row; ++j)
    for (size_t i = 0; i < row; ++i) {
      const double x = side_m * (double(i) / cuts - 0.5), z = side_m * (0.5 - double(j) / cuts);
      points[j * row + i] = {x, relief.height(x, z), z};
    }
  std::vector<std::array<uint32_t, 3>> triangles;
  triangles.reserve(2 * size_t(cuts) * size_t(cuts));
  for (uint32_t j = 0; j < uint32_t(cuts); ++j)
    for (uint32_t i = 0; i < uint32_t(cuts); ++i) {
      const uint32_t a = j * uint32_t(row) + i, c = a + 1, d = a + uint32_t(row), e = d + 1;
      // The diagonal that bends less.
      const bool rising = std::abs(points[a].y - points[e].y) < std::abs(points[c].y - points[d].y);
      triangles.push_back(rising ? std::array{a, c, e} : std::array{a, c, d});
      triangles.push_back(rising ? std::array{a, e, d} : std::array{c, e, d});
    }
  std::vector<dvec3> face(triangles.size());
  for (size_t t = 0; t < triangles.size(); ++t) {
    const auto [p, q, r] = triangles[t];
    face[t] = glm::cross(points[q] - points[p], points[r] - points[p]);
    for (const uint32_t k : triangles[t]) normals[k] += face[t];
  }
  const char* names[ground_count]{"meadow", "scree", "rock", "snow"};
  std::array<std::vector<int64_t>, ground_count> number;
  std::array<Mesh, ground_count> meshes;
  for (size_t g = 0; g < ground_count; ++g) {
    number[g].assign(points.size(), -1);
    meshes[g].name = names[g], meshes[g].material = materials[g];
  }
  for (size_t t = 0; t < triangles.size(); ++t) {
    const dvec3& p = points[triangles[t][0]];
    const Ground g = ground_of(p, glm::normalize(face[t]), noise({p.x / 90.0, 0.2, p.z / 90.0}, 3));
    Mesh& mesh = meshes[g];
    for (const uint32_t k : triangles[t]) {
      if (number[g][k] < 0) {
        number[g][k] = int64_t(mesh.positions.size());
        mesh.positions.emplace_back(points[k]);
        mesh.normals.emplace_back(glm::normalize(normals[k]));
      }
      mesh.indices.push_back(uint32_t(number[g][k]));
    }
  }
  for (Mesh& mesh : meshes) {
    if (mesh.indices.empty()) continue;
    b.scene().meshes.push_back(std::move(mesh));
    b.scene().instances.push_back({uint32_t(b.scene().meshes.size() - 1), glm::dmat4{1.0}});
  }
}

/// A fir of ragged tiers, 1 m high.
Pen fir(Builder& b, const char* name, uint32_t needles, uint64_t stream, int tiers, int sides) {
  const Pen pen = b.part(name, needles);
  Random random = b.random(stream);
  for (int k = 0; k < tiers; ++k) {
    const double low = 0.08 + 0.80 * k / tiers, high = std::min(1.0, low + 1.55 / tiers),
                 radius = 0.23 * (1.0 - 0.85 * k / tiers);
    std::vector<double> reach;
    for (int i = 0; i < sides; ++i) reach.push_back(radius * random.between(0.75, 1.15));
    pen.surface(sides, 1, {.wrap_u = true, .pole_end = true}, [&](double u, double v) {
      const dvec2 on = on_circle(2.0 * std::numbers::pi * u + k);
      const double r = (1.0 - v) * reach[size_t(u * sides + 0.5) % size_t(sides)];
      return dvec3{r * on.x, glm::mix(low, high, v), -r * on.y};
    });
  }
  return pen;
}

}  // namespace

void build_terrain(Builder& b) {
  const std::array<uint32_t, ground_count> materials{
      b.material("meadow", {0.17f, 0.20f, 0.08f}), b.material("scree", {0.34f, 0.29f, 0.23f}),
      b.material("rock", {0.27f, 0.23f, 0.20f}), b.material("snow", {0.82f, 0.84f, 0.88f})};
  const uint32_t needles = b.material("needles", {0.06f, 0.11f, 0.05f}, true);

  const int cuts = b.pieces(822, 16);
  const int tiers = b.pieces(5, 2), sides = b.pieces(8, 4);
  const int firs = b.rounded(1900 * std::min(1.5, b.detail()), 10);
  const Pen shapes[]{fir(b, "fir", needles, 1, tiers, sides), fir(b, "spruce", needles, 2, tiers + 1, sides),
                     fir(b, "young fir", needles, 3, tiers, sides)};
  b.add_count(2 * size_t(cuts) * size_t(cuts));
  const uint32_t seed = uint32_t(b.random(9).bits() >> 40);
  if (b.counting()) {
    for (int i = 0; i < firs; ++i) b.place(shapes[i % 3], glm::dmat4{1.0});
  } else {
    const Relief relief{seed};
    add_surface(b, relief, materials, cuts);
    Random random = b.random(10);
    for (int i = 0, tries = 0; i < firs; ++tries) {
      const double x = random.between(-0.49, 0.49) * side_m, z = random.between(-0.49, 0.49) * side_m;
      const double y = relief.height(x, z), h = random.between(11.0, 24.0), turn = random.between(0, 360);
      const double step = 12.0, dx = relief.height(x + step, z) - y, dz = relief.height(x, z + step) - y;
      const bool wood =
          noise({x / 260.0, 0.0, z / 260.0}, 91) > 0.05 && dx * dx + dz * dz < 0.35 * step * step && y < 560.0;
      if (!wood && tries < 400000) continue;
      b.place(shapes[i % 3], at({x, y - 0.06 * h, z}, turn) * glm::dmat4{glm::dmat3{h}});
      ++i;
    }
  }
  b.camera("main", {{-250.0, 980.0, 3150.0}, {-60.0, 440.0, 300.0}}, 44.0);
  b.path({{{900.0, 1500.0, 3400.0}, {0.0, 400.0, 0.0}},
          {{-100.0, 1050.0, 2600.0}, {-100.0, 420.0, 0.0}},
          {{-250.0, 900.0, 1300.0}, {200.0, 480.0, -900.0}},
          {{200.0, 1250.0, 200.0}, {900.0, 500.0, -1500.0}},
          {{1400.0, 1700.0, 500.0}, {0.0, 500.0, -600.0}}},
         20.0, false, 50.0);
  b.sun("low sun", 243.0, 19.0, {1.0f, 0.82f, 0.62f}, 3.4f);
}

}  // namespace izb::procedural
