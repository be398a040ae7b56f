// SPDX-License-Identifier: MIT
#include "scene/procedural/parts.h"

#include <algorithm>
#include <set>
#include <vector>

#include "scene/portable_math.h"

namespace izb::procedural {

using glm::dvec2;
using glm::dvec3;

void add_wall(const Pen& pen, double length, double bottom, double top, double thickness,
              std::span<const Opening> openings) {
  std::set<double> columns{0.0, length}, rows{bottom, top};
  for (const Opening& o : openings) columns.insert({o.left, o.right}), rows.insert({o.bottom, o.top});
  const std::vector<double> x(columns.begin(), columns.end()), y(rows.begin(), rows.end());
  const int nx = int(x.size()) - 1, ny = int(y.size()) - 1;
  const auto solid = [&](int i, int j) {
    if (i < 0 || j < 0 || i >= nx || j >= ny) return false;
    const double cx = 0.5 * (x[size_t(i)] + x[size_t(i) + 1]), cy = 0.5 * (y[size_t(j)] + y[size_t(j) + 1]);
    return std::none_of(openings.begin(), openings.end(),
                        [&](const Opening& o) { return cx > o.left && cx < o.right && cy > o.bottom && cy < o.top; });
  };
  for (int i = 0; i < nx; ++i)
    for (int j = 0; j < ny; ++j) {
      if (!solid(i, j)) continue;
      const double l = x[size_t(i)], r = x[size_t(i) + 1], b = y[size_t(j)], t = y[size_t(j) + 1], k = -thickness;
      pen.quad({dvec3{l, b, 0}, dvec3{r, b, 0}, dvec3{r, t, 0}, dvec3{l, t, 0}});
      pen.quad({dvec3{r, b, k}, dvec3{l, b, k}, dvec3{l, t, k}, dvec3{r, t, k}});
      if (!solid(i - 1, j)) pen.quad({dvec3{l, b, k}, dvec3{l, b, 0}, dvec3{l, t, 0}, dvec3{l, t, k}});
      if (!solid(i + 1, j)) pen.quad({dvec3{r, b, 0}, dvec3{r, b, k}, dvec3{r, t, k}, dvec3{r, t, 0}});
      if (!solid(i, j - 1)) pen.quad({dvec3{l, b, k}, dvec3{r, b, k}, dvec3{r, b, 0}, dvec3{l, b, 0}});
      if (!solid(i, j + 1)) pen.quad({dvec3{l, t, 0}, dvec3{r, t, 0}, dvec3{r, t, k}, dvec3{l, t, k}});
    }
}

void add_window(const Pen& frame, const Pen* glass, const Opening& o, double depth, int columns, int rows) {
  constexpr double border = 0.055, bar = 0.030, lap = 0.012;  // the frame reaches into the reveal
  const double front = -depth, back = -depth - 0.06;
  frame.box({o.left - lap, o.bottom - lap, back}, {o.left + border, o.top + lap, front});
  frame.box({o.right - border, o.bottom - lap, back}, {o.right + lap, o.top + lap, front});
  frame.box({o.left + border - 0.004, o.bottom - lap + 0.001, back + 0.004},
            {o.right - border + 0.004, o.bottom + border, front - 0.004});
  frame.box({o.left + border - 0.004, o.top - border, back + 0.004},
            {o.right - border + 0.004, o.top + lap - 0.001, front - 0.004});
  for (int i = 1; i < columns; ++i) {
    const double x = glm::mix(o.left, o.right, double(i) / columns);
    frame.box({x - bar / 2, o.bottom + border - 0.004, back + 0.010},
              {x + bar / 2, o.top - border + 0.004, front - 0.010});
  }
  for (int j = 1; j < rows; ++j) {
    const double y = glm::mix(o.bottom, o.top, double(j) / rows);
    frame.box({o.left + border - 0.004, y - bar / 2, back + 0.014},
              {o.right - border + 0.004, y + bar / 2, front - 0.014});
  }
  if (glass) {
    const double z = back + 0.02;
    glass->quad(
        {dvec3{o.left, o.bottom, z}, dvec3{o.right, o.bottom, z}, dvec3{o.right, o.top, z}, dvec3{o.left, o.top, z}});
  }
}

void add_steps(const Pen& pen, int count, double rise, double tread, double width) {
  for (int i = 0; i < count; ++i)  // each a little into the one before, none in its planes
    pen.box({tread * i, -0.05 - 0.003 * (i % 2), 0.003 * (i % 2)},
            {tread * (i + 1) + 0.02, rise * (i + 1), width - 0.003 * (i % 2)});
}

void add_baluster(const Pen& pen, double height, double r, int sides) {
  const std::vector<dvec2> profile{{0, -0.02},       {r, -0.02},       {r, -0.02},      {r, 0.10},
                                   {r, 0.10},        {0.55 * r, 0.13}, {0.5 * r, 0.18}, {0.8 * r, 0.27},
                                   {0.95 * r, 0.36}, {0.8 * r, 0.48},  {0.5 * r, 0.66}, {0.42 * r, 0.78},
                                   {0.7 * r, 0.83},  {0.45 * r, 0.87}, {0.9 * r, 0.92}, {0.9 * r, 0.92},
                                   {0.9 * r, 1.02},  {0.9 * r, 1.02},  {0, 1.02}};
  std::vector<dvec2> scaled;
  for (const dvec2& p : profile) scaled.push_back({p.x, p.y * height});
  pen.lathe(scaled, sides);
}

void add_column(const Pen& pen, double height, double r, int sides) {
  const double h = height;
  pen.box({-1.45 * r, -0.05, -1.45 * r}, {1.45 * r, 0.55 * r, 1.45 * r});
  pen.box({-1.4 * r, h - 0.45 * r, -1.4 * r}, {1.4 * r, h + 0.02, 1.4 * r});
  const std::vector<dvec2> profile{{0, 0.4 * r},
                                   {1.35 * r, 0.4 * r},
                                   {1.35 * r, 0.4 * r},
                                   {1.35 * r, 0.7 * r},
                                   {1.25 * r, 0.85 * r},
                                   {1.08 * r, 0.95 * r},
                                   {1.15 * r, 1.05 * r},
                                   {1.02 * r, 1.2 * r},
                                   {r, 0.33 * h},
                                   {0.93 * r, 0.66 * h},
                                   {0.84 * r, h - 1.5 * r},
                                   {0.84 * r, h - 1.5 * r},
                                   {0.95 * r, h - 1.45 * r},
                                   {0.95 * r, h - 1.3 * r},
                                   {0.86 * r, h - 1.2 * r},
                                   {1.0 * r, h - 0.9 * r},
                                   {1.28 * r, h - 0.6 * r},
                                   {1.28 * r, h - 0.4 * r},
                                   {1.28 * r, h - 0.4 * r},
                                   {0, h - 0.4 * r}};
  pen.lathe(profile, sides);
}

void add_tree(const Pen& wood, const Pen& leaves, Random random, const TreeShape& shape, int leaf_count, double leaf_m,
              int sides) {
  const auto jitter = [&](double size) {
    const double x = random.between(-size, size), y = random.between(-size, size);
    return dvec3{x, y, random.between(-size, size)};
  };
  const double stem = 0.022 * shape.height + 0.02;
  const dvec3 top{0, 0.93 * shape.height, 0};
  const dvec3 fork{0.01 * shape.height, glm::mix(shape.crown_bottom, shape.height, shape.pointed ? 0.7 : 0.25), 0};
  wood.tube(std::array{dvec3{0, -0.3, 0}, dvec3{-0.01 * shape.height, 0.4 * fork.y, 0.006 * shape.height}, fork,
                       glm::mix(fork, top, 0.8)},
            std::array{1.5 * stem, 1.05 * stem, 0.8 * stem, 0.2 * stem}, sides);
  // Boughs carry the clusters of a broad crown.
  std::vector<dvec3> clusters;
  const int boughs = shape.pointed ? 0 : std::clamp(leaf_count / 30, 2, 11);
  const double middle = 0.5 * (shape.crown_bottom + shape.height), half = 0.5 * (shape.height - shape.crown_bottom);
  for (int i = 0; i < boughs; ++i) {
    const double turn = 2.4 * i + random.between(-0.3, 0.3), lift = random.between(-0.55, 0.75);
    const dvec2 on = on_circle(turn);
    const double reach = shape.crown_radius * 0.62 * std::sqrt(std::max(0.0, 1.0 - lift * lift));
    const dvec3 end{reach * on.x, middle + half * 0.66 * lift, reach * on.y};
    clusters.push_back(end);
    const dvec3 root = glm::mix(fork, dvec3{0, 0.6 * fork.y, 0}, random.between(0.0, 0.8));
    wood.tube(std::array{root, glm::mix(root, end, 0.55) + dvec3{0, 0.04 * shape.height, 0}, end},
              std::array{0.5 * stem, 0.33 * stem, 0.12 * stem}, std::max(3, sides / 2));
  }
  clusters.push_back({0, shape.height - 0.42 * half, 0});
  for (int i = 0; i < leaf_count; ++i) {
    dvec3 out = jitter(1.0), centre;
    for (int tries = 0; tries < 6 && (glm::dot(out, out) > 1.0 || glm::dot(out, out) < 0.02); ++tries)
      out = jitter(1.0);
    out = glm::normalize(out + dvec3{1e-3, 0, 0});
    if (shape.pointed) {
      const double t = random.between(0.0, 1.0), y = glm::mix(shape.crown_bottom, shape.height, t);
      const double r = shape.crown_radius * std::sqrt(std::max(0.0, 1.0 - t)) * (0.7 + 0.3 * smooth_step(0.0, 0.25, t));
      const dvec3 level = glm::normalize(dvec3{out.x, 0, out.z} + dvec3{0, 0, 1e-3});
      centre = level * (r * (1.0 - 0.3 * random.between(0, 1) * random.between(0, 1))) + dvec3{0, y, 0};
      out = glm::normalize(level + dvec3{0, 0.8, 0});
    } else {
      const dvec3& cluster = clusters[random.below(uint32_t(clusters.size()))];
      const double r = std::sqrt(random.between(0.12, 1.0)) * 0.46;
      centre = cluster + out * dvec3{shape.crown_radius * r, half * 0.9 * r, shape.crown_radius * r};
    }
    const dvec3 axis = glm::normalize(out + jitter(0.7)), side = across(axis + jitter(0.2)) * (0.28 * leaf_m);
    const dvec3 tip = centre + axis * (0.5 * leaf_m), root = centre - axis * (0.5 * leaf_m);
    leaves.triangle(root - side, root + side, tip);
  }
}

void add_blade(const Pen& pen, const dvec3& root, double height, double width, double facing, double bend, int levels) {
  const dvec2 on = on_circle(facing);
  const dvec3 over{on.x, 0, on.y}, side{-on.y, 0, on.x};
  const auto centre = [&](double t) {
    return root + over * (bend * height * t * t) + dvec3{0, height * (t - 0.35 * bend * t * t), 0};
  };
  pen.surface(1, levels, {.pole_end = true},
              [&](double u, double v) { return centre(v) + side * (width * (u - 0.5) * (1.0 - 0.55 * v * v)); });
}

namespace {

/// A random number in [-1, 1] for each point of a lattice.
double at_lattice(int64_t x, int64_t y, int64_t z, uint32_t seed) {
  uint64_t h = uint64_t(x) * 0x9e3779b97f4a7c15ull ^ uint64_t(y) * 0xc2b2ae3d27d4eb4full ^
               uint64_t(z) * 0x165667b19e3779f9ull ^ uint64_t { seed } * 0x27d4eb2f165667c5ull;
  h = (h ^ (h >> 29)) * 0xbf58476d1ce4e5b9ull;
  h = (h ^ (h >> 32)) * 0x94d049bb133111ebull;
  return double((h ^ (h >> 31)) >> 11) * 0x1p-52 - 1.0;
}

}  // namespace

double noise(const dvec3& p, uint32_t seed) {
  const dvec3 cell = glm::floor(p), f = p - cell, t = f * f * f * (f * (f * 6.0 - 15.0) + 10.0);
  const int64_t x = int64_t(cell.x), y = int64_t(cell.y), z = int64_t(cell.z);
  const auto row = [&](int64_t j, int64_t k) {
    return glm::mix(at_lattice(x, y + j, z + k, seed), at_lattice(x + 1, y + j, z + k, seed), t.x);
  };
  const auto layer = [&](int64_t k) { return glm::mix(row(0, k), row(1, k), t.y); };
  return glm::mix(layer(0), layer(1), t.z);
}

double fractal_noise(dvec3 p, int octaves, uint32_t seed) {
  double sum = 0.0, size = 0.5;
  for (int i = 0; i < octaves; ++i) {
    sum += size * noise(p, seed + uint32_t(i));
    p = dvec3{1.6 * p.x + 1.2 * p.z, 2.03 * p.y, 1.6 * p.z - 1.2 * p.x} + 17.3;  // twice as fine, turned
    size *= 0.5;
  }
  return sum;
}

}  // namespace izb::procedural
