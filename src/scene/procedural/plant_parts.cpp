// SPDX-License-Identifier: MIT
#include "scene/procedural/plant_parts.h"

#include <algorithm>
#include <array>

#include "scene/portable_math.h"

namespace izb::procedural {

using glm::dmat4;
using glm::dvec2;
using glm::dvec3;

PlantPalette::PlantPalette(Builder& b) {
  concrete = b.material("concrete", {0.47f, 0.45f, 0.42f});
  earth = b.material("earth", {0.26f, 0.24f, 0.17f});
  asphalt = b.material("asphalt", {0.16f, 0.16f, 0.17f});
  white = b.material("white paint", {0.75f, 0.75f, 0.73f});
  steel = b.material("steel", {0.33f, 0.20f, 0.16f});
  grating = b.material("grating", {0.36f, 0.37f, 0.38f});
  cladding = b.material("cladding", {0.55f, 0.60f, 0.63f}, true);
  lagging = b.material("lagging", {0.62f, 0.60f, 0.55f});
  rust = b.material("rust", {0.34f, 0.19f, 0.12f});
  yellow = b.material("yellow paint", {0.66f, 0.50f, 0.09f});
  blue = b.material("blue paint", {0.12f, 0.25f, 0.42f});
  coal = b.material("coal", {0.05f, 0.05f, 0.055f});
  const glm::vec3 colors[]{{0.60f, 0.58f, 0.53f}, {0.45f, 0.47f, 0.48f}, {0.16f, 0.34f, 0.24f},
                           {0.55f, 0.17f, 0.11f}, {0.17f, 0.30f, 0.47f}, {0.62f, 0.51f, 0.19f}};
  const char* names[]{"lagged pipe", "steel pipe", "green pipe", "red pipe", "blue pipe", "yellow pipe"};
  for (size_t i = 0; i < 6; ++i) pipes[i] = b.material(names[i], colors[i]);
}

double PlantParts::few() const {
  return std::min(1.0, b.detail());
}

void PlantParts::girder(uint32_t material, const dvec3& from, const dvec3& to, double depth, const dvec3& up) const {
  const Pen pen = b.pen(material);
  if (!b.keeps(0.16)) return pen.beam(from, to, 0.6 * depth, depth, up);
  const dvec3 along = glm::normalize(to - from), side = glm::normalize(glm::cross(along, up)),
              above = glm::cross(side, along);
  const double flange = 0.09 * depth, web = 0.07 * depth, k = 0.5 * (depth - flange);
  pen.beam(from + above * k, to + above * k, 0.62 * depth, flange, above);
  pen.beam(from - above * k, to - above * k, 0.62 * depth, flange, above);
  pen.beam(from + along * 0.004, to - along * 0.004, web, depth - 1.7 * flange, above);
}

void PlantParts::truss(uint32_t material, const dvec3& from, const dvec3& to, double height, int bays) const {
  const dvec3 up{0, height, 0};
  const Pen pen = b.pen(material);
  const int n = b.keeps(0.08) ? bays : bays / 7;
  for (int i = 0; i <= n; ++i) {
    const dvec3 low = glm::mix(from, to, double(i) / n), next = glm::mix(from, to, double(i + 1) / n);
    pen.beam(low + 0.02 * up, low + 0.98 * up, 0.11, 0.11, to - from);
    if (i == n) break;
    // Chords in pieces, as they are delivered; one long sliver is more than rasterisers place well.
    girder(material, low, next, 0.24, {0, 1, 0});
    girder(material, low + up, next + up, 0.24, {0, 1, 0});
    pen.beam(i % 2 == 0 ? low : low + up, i % 2 == 0 ? next + up : next, 0.08, 0.08, {0, 1, 0.001});
    if (b.keeps(0.4))  // gusset plates
      pen.beam(low - 0.05 * up, low + 0.05 * up, 0.14, 0.4, to - from);
  }
}

void PlantParts::pylon(const dvec3& foot, double height, double width) const {
  const Pen pen = b.pen(p.yellow);
  const auto corner = [&](int i, double y) {
    const double w = 0.5 * width * (1.0 - 0.35 * y / height);
    return foot + dvec3{i % 3 == 0 ? -w : w, y, i < 2 ? w : -w};
  };
  const int levels = std::max(2, int(height / (0.9 * width)));
  for (int i = 0; i < 4; ++i) {
    pen.beam(corner(i, -0.1), corner(i, height), 0.2, 0.2, {1, 0, 0.01});
    for (int k = 0; k < levels && b.keeps(0.1); ++k) {
      const double low = height * k / levels, high = height * (k + 1) / levels;
      pen.beam(corner(i, low), corner((i + 1) % 4, high), 0.07, 0.07, {0.01, 1, 0});
      pen.beam(corner((i + 1) % 4, low + 0.05), corner(i, high - 0.05), 0.075, 0.075, {0.01, 1, 0});
      pen.beam(corner(i, high - 0.02), corner((i + 1) % 4, high - 0.02), 0.085, 0.085, {0.01, 1, 0});
    }
  }
}

void PlantParts::grating(const dvec3& low, const dvec3& high) const {
  const Pen pen = b.pen(p.grating);
  const double y = low.y;
  if (!b.keeps(0.04)) return;
  if (!b.keeps(0.25)) return pen.box({low.x, y - 0.05, low.z}, {high.x, y, high.z});
  const int bars = b.rounded(std::min(1.0, 0.15 + 0.85 * b.detail()) * (high.x - low.x) / 0.075, 2);
  for (int i = 0; i < bars; ++i) {
    const double x = glm::mix(low.x, high.x, (i + 0.5) / bars);
    pen.box({x - 0.006, y - 0.045, low.z}, {x + 0.006, y - 0.003, high.z});
  }
  const int rods = b.rounded(std::min(1.0, 0.15 + 0.85 * b.detail()) * (high.z - low.z) / 0.42, 2);
  for (int i = 0; i < rods; ++i) {
    const double z = glm::mix(low.z, high.z, (i + 0.5) / rods);
    pen.box({low.x + 0.02, y - 0.030, z - 0.006}, {high.x - 0.02, y, z + 0.006});
  }
}

void PlantParts::railing(const dvec3& from, const dvec3& to) const {
  if (!b.keeps(0.14)) return;
  const Pen pen = b.pen(p.yellow);
  const double length = glm::length(to - from);
  const int sides = b.pieces(9, 3), posts = b.rounded(std::min(1.0, 3.0 * b.detail()) * length / 1.4, 2);
  for (const double y : {0.55, 1.08}) pen.rod(from + dvec3{0, y, 0}, to + dvec3{0, y, 0}, 0.022, sides);
  for (int i = 0; i <= posts; ++i) {
    const dvec3 at = glm::mix(from, to, 0.002 + 0.996 * i / posts);
    pen.rod(at - dvec3{0, 0.1, 0}, at + dvec3{0, 1.09, 0}, 0.024, sides);
    if (b.keeps(0.7)) pen.ball(at + dvec3{0, 0.55, 0}, 0.034, std::max(4, sides / 2 * 2));
  }
  pen.beam(from + dvec3{0, 0.06, 0}, to + dvec3{0, 0.06, 0}, 0.012, 0.13, {0, 1, 0});
}

void PlantParts::stair(const dvec3& foot, double turn_deg, double rise, double width) const {
  if (!b.keeps(0.08)) return;
  const int steps = b.keeps(0.2) ? 28 : 9;
  const double run = 1.12 * rise;
  const dmat4 place = at(foot, turn_deg);
  const Pen pen = b.pen(p.steel, place), tread = b.pen(p.grating, place);
  for (const double z : {0.0, width}) {
    pen.beam({-0.1, -0.06, z}, {run, rise - 0.06, z}, 0.05, 0.26, {0, 1, 0});
    if (!b.keeps(0.2)) continue;
    for (const double y : {0.55, 1.0}) b.pen(p.yellow, place).rod({0, y, z}, {run, rise + y, z}, 0.02, b.pieces(9, 3));
    for (int i = 0; i <= 6; ++i)
      b.pen(p.yellow, place)
          .rod({run * i / 6, rise * i / 6 - 0.05, z}, {run * i / 6, rise * i / 6 + 1.01, z}, 0.021, b.pieces(9, 3));
  }
  for (int i = 0; i < steps; ++i) {
    const double x = run * (i + 0.5) / steps, y = rise * (i + 0.5) / steps;
    const int bars = b.rounded(std::min(1.0, 0.6 * b.detail()) * 9.0, 1);
    for (int k = 0; k < bars; ++k) {
      const double w = 0.28 / bars, left = x - 0.14 + w * k;
      tread.box({left, y - 0.03, 0.02}, {left + std::min(w * 0.6, 0.28), y, width - 0.02});
    }
  }
}

void PlantParts::corrugated(const dvec3& low, const dvec3& high) const {
  const dvec3 across_m = dvec3{high.x - low.x, 0, high.z - low.z};
  const double length = glm::length(across_m), height = high.y - low.y;
  const dvec3 along = across_m / length, out = glm::cross(along, dvec3{0, 1, 0});
  const int waves = b.rounded(few() * length / 0.9, 1), n = b.keeps(0.2) ? b.pieces(6, 4) : 1;
  b.pen(p.cladding).surface(waves * n, b.pieces(3, 1), {}, [&](double u, double v) {
    const double wave = n > 1 ? 0.05 * sine(2.0 * std::numbers::pi * u * waves) : 0.0;
    return low + along * (length * u) + dvec3{0, height * v, 0} + out * wave;
  });
}

void PlantParts::ribs(const dvec3& low, const dvec3& high, double step) const {
  if (!b.keeps(0.15)) return;
  const Pen pen = b.pen(p.lagging);
  for (double y = low.y + 0.5 * step; y < high.y; y += step)
    pen.box({low.x - 0.12, y, low.z - 0.12}, {high.x + 0.12, y + 0.14, high.z + 0.12});
  for (double x = low.x + step; x < high.x - 0.2; x += 2.0 * step)
    pen.box({x, low.y + 0.05, low.z - 0.09}, {x + 0.12, high.y - 0.05, high.z + 0.09});
}

void PlantParts::door(uint32_t material, const dvec3& foot, double width, double height) const {
  const Pen pen = b.pen(material, translated(foot));
  pen.box({-0.5 * width, -0.02, -0.1}, {0.5 * width, height, 0.06});
  for (int i = 0; i < 8 && b.keeps(0.2); ++i)
    pen.box({-0.48 * width, 0.1 + (height - 0.3) * i / 8, 0.0},
            {0.48 * width, 0.1 + (height - 0.3) * (i + 0.7) / 8, 0.085});
}

void PlantParts::pipe(const Pen& pen, const std::vector<dvec3>& way, double radius, double sides) const {
  const int around = b.pieces(sides, 3), turns = b.pieces(0.55 * sides, 1);
  std::vector<dvec3> path{way.front()};
  for (size_t i = 1; i + 1 < way.size(); ++i) {
    const dvec3 in = way[i] - way[i - 1], out = way[i + 1] - way[i];
    const double cut = std::min({3.0 * radius, 0.45 * glm::length(in), 0.45 * glm::length(out)});
    const dvec3 a = way[i] - cut * glm::normalize(in), c = way[i] + cut * glm::normalize(out);
    if (turns == 1) {
      path.push_back(way[i]);
      continue;
    }
    for (int k = 0; k <= turns; ++k) {
      const double t = double(k) / turns;
      path.push_back(glm::mix(glm::mix(a, way[i], t), glm::mix(way[i], c, t), t));
    }
  }
  path.push_back(way.back());
  pen.tube(path, radius, around);
}

void PlantParts::flange(uint32_t material, const dvec3& at_point, const dvec3& axis, double radius) const {
  const dmat4 place = along(at_point, axis);
  const Pen pen = b.pen(material, place);
  if (!b.keeps(0.1)) return;
  const double r = radius, t = 0.16 * radius + 0.012;
  const int sides = b.pieces(22, 5);
  for (const double y : {-1.08 * t, 0.08 * t})
    pen.lathe(
        std::array{dvec2{0, y}, dvec2{1.45 * r, y}, dvec2{1.45 * r, y}, dvec2{1.62 * r, y + 0.15 * t},
                   dvec2{1.62 * r, y + 0.85 * t}, dvec2{1.45 * r, y + t}, dvec2{1.45 * r, y + t}, dvec2{0, y + t}},
        sides);
  if (!b.keeps(0.5)) return;
  for (int i = 0; i < 8; ++i) {  // bolts
    const dvec2 on = on_circle(2.0 * std::numbers::pi * (i + 0.5) / 8);
    b.pen(p.grating, place)
        .rod({1.34 * r * on.x, -1.5 * t, 1.34 * r * on.y}, {1.34 * r * on.x, 1.5 * t, 1.34 * r * on.y}, 0.1 * r + 0.004,
             6);
  }
}

void PlantParts::valve(uint32_t material, const dvec3& at_point, const dvec3& axis, double radius) const {
  const double r = radius;
  const dvec3 up = std::abs(axis.y) < 0.7 ? dvec3{0, 1, 0} : dvec3{0, 0, 1};
  const int sides = b.pieces(20, 5);
  b.pen(material, along(at_point, axis))
      .lathe(std::array{dvec2{0, -1.6 * r}, dvec2{0.9 * r, -1.6 * r}, dvec2{1.5 * r, -0.8 * r}, dvec2{1.75 * r, 0.0},
                        dvec2{1.5 * r, 0.8 * r}, dvec2{0.9 * r, 1.6 * r}, dvec2{0, 1.6 * r}},
             sides);
  const dvec3 top = at_point + up * (3.6 * r);
  b.pen(material).rod(at_point, at_point + up * (2.4 * r), 0.7 * r, sides);
  b.pen(p.grating).rod(at_point, top + up * (0.3 * r), 0.14 * r, std::max(3, sides / 2));
  b.pen(p.pipes[3]).ring(top, up, 1.3 * r, 0.11 * r, b.pieces(26, 6), b.pieces(8, 3));
  const dvec3 side = across(up), other = glm::cross(up, side);
  for (const dvec3& spoke : {side, other})
    b.pen(p.pipes[3]).rod(top - spoke * (1.28 * r), top + spoke * (1.28 * r), 0.07 * r, std::max(3, sides / 3));
}

void PlantParts::pipe_run(uint32_t material, const std::vector<dvec3>& way, double radius, Random& random) const {
  pipe(b.pen(material), way, radius, 20);
  if (!b.keeps(0.35)) return;
  for (size_t i = 0; i + 1 < way.size(); ++i) {
    const dvec3 leg = way[i + 1] - way[i];
    const double length = glm::length(leg);
    const dvec3 axis = leg / length;
    if (length < 10.0 * radius) continue;
    const double inset = 5.0 * radius;
    flange(material, way[i] + axis * inset, axis, radius);
    flange(material, way[i + 1] - axis * inset, axis, radius);
    if (random.below(4) == 0 && length > 24.0 * radius) valve(material, way[i] + 0.5 * leg, axis, radius);
    if (std::abs(axis.y) > 0.5 || !b.keeps(0.5)) continue;
    for (double s = 1.0; s < length - 0.8; s += 2.4) {  // hangers
      const dvec3 at_point = way[i] + axis * s;
      b.pen(p.grating).ring(at_point, axis, radius + 0.006, 0.014, b.pieces(20, 6), 4);
      b.pen(p.grating).rod(at_point + dvec3{0, radius, 0}, at_point + dvec3{0, radius + 0.7, 0}, 0.010, b.pieces(6, 3));
    }
  }
}

void PlantParts::vessel(uint32_t material, const dvec3& from, const dvec3& to, double radius) const {
  const double length = glm::length(to - from), r = radius;
  std::vector<dvec2> profile{{0, 0}};
  const int cuts = b.pieces(12, 3);
  for (int i = 1; i <= cuts; ++i) {
    const dvec2 on = on_circle(0.5 * std::numbers::pi * i / cuts);
    profile.push_back({r * on.y, 0.6 * r * (1.0 - on.x)});
  }
  for (int i = cuts; i >= 0; --i) profile.push_back({profile[size_t(i)].x, length - profile[size_t(i)].y});
  b.pen(material, along(from, to - from)).lathe(profile, b.pieces(44, 6));
  for (const double t : {0.25, 0.75}) {
    const dvec3 at_point = glm::mix(from, to, t), axis = glm::normalize(to - from);
    if (b.keeps(0.2)) b.pen(p.steel).ring(at_point, axis, r + 0.01, 0.05, b.pieces(44, 8), 5);
    b.pen(p.concrete).beam(at_point - dvec3{0, r + 0.5, 0}, at_point - dvec3{0, 0.6 * r, 0}, 0.4, 1.5 * r, axis);
  }
  flange(material, from + (to - from) * 0.5 + dvec3{0, r + 0.2, 0}, {0, 1, 0}, 0.25 * r);
  b.pen(material).rod(from + (to - from) * 0.5 + dvec3{0, 0.5 * r, 0}, from + (to - from) * 0.5 + dvec3{0, r + 0.2, 0},
                      0.24 * r, b.pieces(20, 5));
}

void PlantParts::duct(const dvec3& from, const dvec3& to, double width) const {
  b.pen(p.lagging).beam(from, to, width, width, {0, 1, 0});
  const int bands = b.keeps(0.1) ? 9 : 0;
  for (int i = 0; i < bands; ++i) {
    const dvec3 q = glm::mix(from, to, (i + 0.5) / bands), half = 0.05 * glm::normalize(to - from);
    b.pen(p.lagging).beam(q - half, q + half, width + 0.2, width + 0.2, {0, 1, 0});
  }
}

void PlantParts::tank(const dvec3& foot, double r, double h) const {
  const Pen pen = b.pen(p.white, translated(foot));
  pen.lathe(std::array{dvec2{0, -0.1}, dvec2{r, -0.1}, dvec2{r, -0.1}, dvec2{r, h}, dvec2{r, h}, dvec2{r + 0.15, h},
                       dvec2{r + 0.15, h}, dvec2{r + 0.15, h + 0.12}, dvec2{r + 0.15, h + 0.12},
                       dvec2{0.5 * r, h + 0.11 * r}, dvec2{0, h + 0.15 * r}},
            b.pieces(90, 8));
  for (int i = 1; i < 5 && b.keeps(0.2); ++i) pen.ring({0, h * i / 5, 0}, {0, 1, 0}, r, 0.05, b.pieces(90, 8), 4);
  // A stair that winds up the wall, and a railing round the top.
  const int steps = b.keeps(0.2) ? int(h / 0.2) : 0;
  for (int i = 0; i < steps; ++i) {
    const Pen step = b.pen(p.grating, translated(foot) * turned(1, 110.0 * i / steps));
    step.box({-0.14, 0.2 * i, r + 0.02}, {0.14, 0.2 * i + 0.03, r + 0.85});
    if (i % 4 == 0)
      b.pen(p.yellow, translated(foot) * turned(1, 110.0 * i / steps))
          .rod({0, 0.2 * i, r + 0.83}, {0, 0.2 * i + 1.05, r + 0.83}, 0.02, b.pieces(8, 3));
  }
  if (!b.keeps(0.2)) return;
  for (const double y : {0.55, 1.05})
    b.pen(p.yellow, translated(foot))
        .ring({0, h + 0.12 + y, 0}, {0, 1, 0}, r + 0.05, 0.02, b.pieces(90, 12), b.pieces(6, 3));
  for (int i = 0; i < 30; ++i) {
    const dvec2 on = on_circle(2.0 * std::numbers::pi * i / 30);
    b.pen(p.yellow, translated(foot))
        .rod({(r + 0.05) * on.x, h, (r + 0.05) * on.y}, {(r + 0.05) * on.x, h + 1.18, (r + 0.05) * on.y}, 0.022,
             b.pieces(8, 3));
  }
}

void PlantParts::silo(const dvec3& foot, double r, double h) const {
  b.pen(p.lagging, translated(foot))
      .lathe(std::array{dvec2{0, 4.0}, dvec2{0.5, 4.0}, dvec2{r, 8.0}, dvec2{r, 8.0}, dvec2{r, h}, dvec2{r, h},
                        dvec2{0.3 * r, h + 1.4}, dvec2{0, h + 1.4}},
             b.pieces(60, 7));
  for (int i = 0; i < 8; ++i) {
    if (!b.keeps(0.03)) continue;
    const dvec2 on = on_circle(2.0 * std::numbers::pi * i / 8);
    girder(p.steel, foot + dvec3{r * on.x, -0.1, r * on.y}, foot + dvec3{r * on.x, 9.0, r * on.y}, 0.3,
           {on.x, 0, on.y});
  }
  for (double y = 9.0; y < h && b.keeps(0.15); y += 1.6)
    b.pen(p.steel, translated(foot)).ring({0, y, 0}, {0, 1, 0}, r + 0.01, 0.05, b.pieces(60, 8), 4);
}

void PlantParts::chimney(const dvec3& foot, double r, double h) const {
  const int sides = b.pieces(72, 8);
  for (int i = 0; i < 6; ++i) {  // bands of paint near the top
    const double y0 = i == 0 ? -0.2 : h * (0.66 + 0.068 * (i - 1)), y1 = h * (0.66 + 0.068 * i);
    const auto radius = [&](double y) { return r * (1.0 - 0.40 * y / h); };
    b.pen(i == 0       ? p.concrete
          : i % 2 == 1 ? p.pipes[3]
                       : p.white,
          translated(foot))
        .surface(sides, b.pieces(i == 0 ? 30 : 4, 1), {.wrap_u = true}, [&](double u, double v) {
          const double y = glm::mix(y0, y1, v);
          const dvec2 on = on_circle(2.0 * std::numbers::pi * u);
          return dvec3{radius(y) * on.x, y, -radius(y) * on.y};
        });
  }
  b.pen(p.concrete, translated(foot))
      .lathe(std::array{dvec2{0.60 * r, h - 0.3}, dvec2{0.63 * r, h - 0.3}, dvec2{0.63 * r, h - 0.3},
                        dvec2{0.63 * r, h + 0.4}, dvec2{0.63 * r, h + 0.4}, dvec2{0.45 * r, h + 0.4},
                        dvec2{0.45 * r, h + 0.4}, dvec2{0.45 * r, h - 6.0}},
             sides);
  for (const double t : {0.5, 0.85}) {
    const double rim = r * (1.0 - 0.40 * t) + 0.9;
    b.pen(p.grating, translated(foot)).ring({0, h * t, 0}, {0, 1, 0}, rim - 0.5, 0.42, sides, b.pieces(8, 4));
    for (int i = 0; i < 24 && b.keeps(0.2); ++i) {
      const dvec2 on = on_circle(2.0 * std::numbers::pi * i / 24);
      b.pen(p.yellow, translated(foot))
          .rod({rim * on.x, h * t, rim * on.y}, {rim * on.x, h * t + 1.2, rim * on.y}, 0.03, b.pieces(6, 3));
    }
    if (b.keeps(0.2))
      b.pen(p.yellow, translated(foot)).ring({0, h * t + 1.2, 0}, {0, 1, 0}, rim, 0.03, sides, b.pieces(6, 3));
  }
  for (double y = 1.0; y < h - 1.0 && b.keeps(0.4); y += 0.45) {  // a ladder
    const double x = r * (1.0 - 0.40 * y / h) + 0.16;
    b.pen(p.grating, translated(foot)).rod({x, y, -0.25}, {x, y, 0.25}, 0.015, b.pieces(6, 3));
  }
}

void PlantParts::cooling_tower(const dvec3& foot, double r, double h) const {
  const auto radius = [&](double t) { return r * (0.58 + 0.42 * (t - 0.78) * (t - 0.78) / (0.78 * 0.78)); };
  const double low = 6.5;
  for (const double inside : {0.0, 0.35})
    b.pen(p.concrete, translated(foot))
        .surface(b.pieces(150, 12), b.pieces(70, 4), {.wrap_u = true}, [&](double u, double v) {
          const double t = inside > 0.0 ? 1.0 - v : v, rr = radius(t) - inside;
          const dvec2 on = on_circle(2.0 * std::numbers::pi * u);
          return dvec3{rr * on.x, glm::mix(low, h, t), -rr * on.y};
        });
  b.pen(p.concrete, translated(foot))
      .ring({0, h, 0}, {0, 1, 0}, radius(1.0) - 0.17, 0.32, b.pieces(150, 12), b.pieces(8, 4));
  const int legs = b.rounded(std::min(1.0, 2.0 * b.detail()) * 44, 4);
  for (int i = 0; i < legs; ++i)
    for (const double lean : {-0.5, 0.5}) {
      const dvec2 on = on_circle(2.0 * std::numbers::pi * i / legs),
                  to = on_circle(2.0 * std::numbers::pi * (i + lean) / legs);
      b.pen(p.concrete)
          .rod(foot + dvec3{(r + 1.2) * on.x, -0.7, -(r + 1.2) * on.y},
               foot + dvec3{(r - 0.17) * to.x, low + 0.2, -(r - 0.17) * to.y}, 0.34, b.pieces(12, 4));
    }
}

void PlantParts::ventilator(const dvec3& foot) const {
  b.pen(p.grating, translated(foot))
      .lathe(std::array{dvec2{0, -0.1}, dvec2{0.7, -0.1}, dvec2{0.7, -0.1}, dvec2{0.7, 1.0}, dvec2{1.2, 1.2},
                        dvec2{1.2, 1.6}, dvec2{0.9, 2.0}, dvec2{0.3, 2.2}, dvec2{0, 2.2}},
             b.pieces(40, 6));
  for (int i = 0; i < 16 && b.keeps(0.4); ++i)
    b.pen(p.grating, translated(foot) * turned(1, 22.5 * i)).box({-0.02, 1.15, 1.0}, {0.02, 1.7, 1.26});
}

}  // namespace izb::procedural
