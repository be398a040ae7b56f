// SPDX-License-Identifier: MIT
// A Mediterranean house over a pool: much that is flat and large, with columns, balusters and slats before it, and
// rooms into which the sun falls through doors and louvres.
#include <algorithm>
#include <vector>

#include "scene/portable_math.h"
#include "scene/procedural/parts.h"
#include "scene/procedural/scenes.h"

namespace izb::procedural {
namespace {

using glm::dmat4;
using glm::dvec2;
using glm::dvec3;

// The house: a ground floor behind a portico, an upper floor over its western part, front to the south (+z).
constexpr double west = -9.0, east = 7.0, north = -6.0, front = 2.0, portico = 5.0;
constexpr double floor_y = 0.45, ceiling = 3.45, terrace = 3.75, eaves = 6.75, upper_east = 1.0, upper_front = 1.2;
constexpr double wall = 0.35;
constexpr Bounds pool{{-4.0, -1.6, 9.0}, {8.0, 0.0, 13.5}};

struct Villa {
  Builder& b;
  uint32_t lawn = b.material("lawn", {0.16f, 0.24f, 0.08f});
  uint32_t paving = b.material("paving", {0.58f, 0.52f, 0.44f});
  uint32_t plaster = b.material("plaster", {0.78f, 0.74f, 0.67f});
  uint32_t stone = b.material("stone", {0.63f, 0.59f, 0.52f});
  uint32_t tile = b.material("roof tile", {0.48f, 0.21f, 0.12f});
  uint32_t wood = b.material("wood", {0.30f, 0.19f, 0.11f});
  uint32_t paint = b.material("blue-green paint", {0.15f, 0.27f, 0.27f});
  uint32_t water = b.material("water", {0.10f, 0.33f, 0.38f});
  uint32_t basin = b.material("basin", {0.45f, 0.62f, 0.64f});
  uint32_t linen = b.material("linen", {0.76f, 0.72f, 0.64f}, true);
  uint32_t rug = b.material("rug", {0.42f, 0.12f, 0.10f});
  uint32_t parquet = b.material("parquet", {0.40f, 0.26f, 0.15f});
  uint32_t terracotta = b.material("terracotta", {0.52f, 0.24f, 0.14f});
  uint32_t leaf = b.material("leaf", {0.12f, 0.20f, 0.07f}, true);
  uint32_t bark = b.material("bark", {0.23f, 0.18f, 0.13f});

  int sides(double at_default) const { return b.pieces(at_default, 4); }

  /// A wall seen from outside from left to right, starting at `corner` and heading `turn_deg` from +x.
  void walls(const dvec3& corner, double turn_deg, double length, double top, const std::vector<Opening>& openings,
             int bars) {
    const dmat4 place = at(corner, turn_deg);
    if (bars == 3 && !b.keeps(0.2)) return add_wall(b.pen(plaster, place), length, 0.0, top, wall, {});
    add_wall(b.pen(plaster, place), length, 0.0, top, wall, openings);
    for (const Opening& o : openings) {
      if (b.keeps(0.3)) add_window(b.pen(paint, place), nullptr, o, 0.14, o.right - o.left > 1.3 ? 2 : 1, bars);
      if (o.bottom > 0.1)
        b.pen(stone, place).box({o.left - 0.1, o.bottom - 0.08, -0.1}, {o.right + 0.1, o.bottom + 0.012, 0.09});
      if (bars == 3 && o.bottom > 0.1 && b.keeps(0.3)) shutters(place, o);
    }
  }

  void shutters(const dmat4& place, const Opening& o) {
    const double width = 0.5 * (o.right - o.left), height = o.top - o.bottom;
    for (const double side : {-1.0, 1.0}) {
      const double x = side < 0.0 ? o.left - width - 0.03 : o.right + 0.03;
      const Pen pen = b.pen(paint, place * translated({x, o.bottom, 0.035}));
      for (const double edge : {0.0, width - 0.06}) pen.box({edge, 0, 0}, {edge + 0.06, height, 0.045});
      for (const double y : {0.0, height - 0.07}) pen.box({0.055, y + 0.002, 0.003}, {width - 0.055, y + 0.068, 0.042});
      const int slats = b.rounded(std::min(1.0, 0.5 + 0.5 * b.detail()) * height / 0.075, 4);
      for (int i = 0; i < slats; ++i) {
        const double y = 0.09 + (height - 0.17) * (i + 0.5) / slats;
        pen.beam({0.05, y, 0.022}, {width - 0.05, y, 0.022}, 0.05, 0.009, {0, 0.7, 0.6});
      }
    }
  }

  void balustrade(const dvec3& from, const dvec3& to) {
    const double length = glm::length(to - from);
    const dvec3 along = (to - from) / length, side = glm::cross(along, dvec3{0, 1, 0});
    const Pen pen = b.pen(stone);
    pen.beam(from + dvec3{0, 0.08, 0}, to + dvec3{0, 0.08, 0}, 0.24, 0.18, {0, 1, 0});
    pen.beam(from + dvec3{0, 0.96, 0} - 0.02 * along, to + dvec3{0, 0.96, 0} + 0.02 * along, 0.26, 0.12, {0, 1, 0});
    const int bays = std::max(1, int(length / 2.3));
    for (int i = 0; i <= bays; ++i) {
      const dvec3 p = from + along * (length * i / bays);
      const dvec3 low = p - 0.14 * glm::abs(along) - 0.14 * glm::abs(side);
      pen.box(low - dvec3{0, 0.03, 0}, p + 0.14 * glm::abs(along) + 0.14 * glm::abs(side) + dvec3{0, 1.09, 0});
      if (i == bays) break;
      const int posts = b.rounded(std::min(1.0, 2.0 * b.detail()) * (length / bays - 0.35) / 0.22, 1);
      for (int k = 0; k < posts; ++k) {
        const dvec3 foot = p + along * (0.14 + (length / bays - 0.28) * (k + 0.5) / posts) + dvec3{0, 0.17, 0};
        if (b.keeps(0.4))
          add_baluster(pen.in(translated(foot)), 0.73, 0.075, sides(9));
        else
          pen.box(foot - dvec3{0.05, 0.02, 0.05}, foot + dvec3{0.05, 0.75, 0.05});
      }
    }
  }

  void site() {
    const Pen grass = b.pen(lawn);
    const double a = -60, c = 60, y = -0.10;
    const auto sheet = [&](double x0, double x1, double z0, double z1) {
      grass.quad({dvec3{x0, y, z1}, dvec3{x1, y, z1}, dvec3{x1, y, z0}, dvec3{x0, y, z0}});
    };
    sheet(a, c, a, pool.min.z), sheet(a, c, pool.max.z, c);
    sheet(a, pool.min.x, pool.min.z, pool.max.z), sheet(pool.max.x, c, pool.min.z, pool.max.z);

    const Pen shell = b.pen(basin);
    const auto [low, high] = pool;
    shell.quad({dvec3{low.x, low.y, high.z}, dvec3{high.x, low.y, high.z}, dvec3{high.x, low.y, low.z}, low});
    const Corners rim{dvec3{low.x, 0, high.z}, dvec3{high.x, 0, high.z}, dvec3{high.x, 0, low.z},
                      dvec3{low.x, 0, low.z}};
    for (size_t i = 0; i < 4; ++i) {
      const dvec3 p = rim[(i + 1) % 4], q = rim[i], down{0, low.y, 0};
      shell.quad({p + down, q + down, q - dvec3{0, 0.11, 0}, p - dvec3{0, 0.11, 0}});
    }
    b.pen(water).surface(sides(24), sides(12), {}, [&](double u, double v) {
      const double x = glm::mix(low.x, high.x, u), z = glm::mix(high.z, low.z, v);
      return dvec3{x, -0.24 + 0.012 * noise({1.3 * x, 0, 1.3 * z}, 5), z};
    });
    pave();
  }

  /// Slabs around the pool and up to the house.
  void pave() {
    const Pen slabs = b.pen(paving);
    Random random = b.random(1);
    const double side_m = b.detail() < 0.3 ? 4.0 : b.detail() < 0.6 ? 2.4 : 1.2;
    for (int i = 0; i * side_m < 21.6; ++i)
      for (int j = 0; j * side_m < 12.0; ++j) {
        const double x0 = -10.6 + side_m * i, z0 = 5.3 + side_m * j;
        const double x1 = x0 + side_m - 0.015, z1 = z0 + side_m - 0.015, h = random.between(0.0, 0.008);
        const auto fit_x = [&](double x) { return x > pool.min.x && x < pool.max.x; };
        const bool wet = fit_x(0.5 * (x0 + x1)) && 0.5 * (z0 + z1) > pool.min.z && 0.5 * (z0 + z1) < pool.max.z;
        if (!wet) slabs.box({x0, -0.16, z0}, {x1, h, z1});
      }
    // The rim lies over the slabs that the basin cuts.
    const Pen edge = b.pen(stone);
    edge.box({pool.min.x - 0.75, -0.2, pool.min.z - 0.7}, {pool.max.x + 0.85, 0.03, pool.min.z + 0.03});
    edge.box({pool.min.x - 0.75, -0.2, pool.max.z - 0.03}, {pool.max.x + 0.85, 0.032, pool.max.z + 0.8});
    edge.box({pool.min.x - 0.73, -0.2, pool.min.z + 0.03}, {pool.min.x + 0.03, 0.031, pool.max.z - 0.03});
    edge.box({pool.max.x - 0.03, -0.2, pool.min.z + 0.03}, {pool.max.x + 0.83, 0.029, pool.max.z - 0.03});
  }

  void house() {
    const Pen solid = b.pen(plaster), trim = b.pen(stone);
    trim.box({west - 0.25, -0.3, north - 0.25}, {east + 0.25, floor_y - 0.02, portico + 0.1});
    b.pen(parquet).box({west + 0.1, floor_y - 0.1, north + 0.1}, {east - 0.1, floor_y, front - 0.1});
    const Pen stair = b.pen(stone, at({1.2, 0.005, portico + 1.29}, 90.0));
    add_steps(stair, 3, 0.14, 0.4, 3.2);

    const double base = floor_y - 0.03, top = ceiling - base;
    std::vector<Opening> doors;
    for (int i = 0; i < 6; ++i) doors.push_back({1.0 + 2.55 * i, 2.55 + 2.55 * i, 0.03, 2.45});
    walls({west, base, front}, 0, east - west, top, doors, 4);
    walls({east, base, front - wall}, 90, front - north - 2 * wall, top, {{0.9, 2.9, 0.03, 2.45}, {4.4, 5.6, 0.9, 2.4}},
          3);
    walls({east, base, north}, 180, east - west, top, {{2, 3.2, 0.9, 2.4}, {6, 7.2, 0.9, 2.4}, {11, 12.2, 0.9, 2.4}},
          3);
    walls({west, base, north + wall}, 270, front - north - 2 * wall, top, {{1.2, 2.4, 0.9, 2.4}, {4.6, 5.8, 0.9, 2.4}},
          3);
    solid.box({west - 0.28, ceiling - 0.02, north - 0.28}, {east + 0.28, terrace, portico + 0.2});
    trim.box({west - 0.34, terrace - 0.14, north - 0.34}, {east + 0.34, terrace + 0.03, portico + 0.28});

    const double upper = eaves - terrace;
    const auto row = [&](int count, double step) {
      std::vector<Opening> openings;
      for (int i = 0; i < count; ++i) openings.push_back({1.0 + step * i, 2.1 + step * i, i == 1 ? 0.05 : 0.85, 2.35});
      return openings;
    };
    walls({west, terrace, upper_front}, 0, upper_east - west, upper, row(4, 2.4), 3);
    walls({upper_east, terrace, upper_front - wall}, 90, upper_front - north - 2 * wall, upper, row(2, 3.2), 3);
    walls({upper_east, terrace, north}, 180, upper_east - west, upper, row(3, 3.0), 3);
    walls({west, terrace, north + wall}, 270, upper_front - north - 2 * wall, upper, row(2, 3.2), 3);

    for (int i = 0; i < 8; ++i) column({west + 0.55 + 2.13 * i, floor_y, portico - 0.35}, ceiling - floor_y - 0.02);
    balustrade({west + 0.1, terrace, portico}, {east + 0.05, terrace, portico});
    balustrade({east + 0.05, terrace, portico - 0.3}, {east + 0.05, terrace, north + 0.1});
    balustrade({east - 0.2, terrace, north + 0.1}, {upper_east + 0.3, terrace, north + 0.1});
    balustrade({west + 0.1, terrace, upper_front + 0.3}, {west + 0.1, terrace, portico - 0.3});
    roof();
  }

  void column(const dvec3& foot, double height) {
    const Pen pen = b.pen(stone, translated(foot));
    if (b.keeps(0.25))
      add_column(pen, height, 0.17, sides(18));
    else
      pen.rod({0, -0.02, 0}, {0, height + 0.01, 0}, 0.16, 5);
  }

  void roof() {
    const double over = 0.55, x0 = west - over, x1 = upper_east + over, z0 = north - over, z1 = upper_front + over;
    b.pen(wood).box({x0 + 0.06, eaves - 0.02, z0 + 0.06}, {x1 - 0.06, eaves + 0.10, z1 - 0.06});
    const double zm = 0.5 * (z0 + z1), run = z1 - zm, rise = 0.36 * run, y = eaves + 0.10;
    const dvec3 ridge_w{x0 + run, y + rise, zm}, ridge_e{x1 - run, y + rise, zm};
    const dvec3 sw{x0, y, z1}, se{x1, y, z1}, ne{x1, y, z0}, nw{x0, y, z0};
    const Pen pen = b.pen(tile);
    pen.quad({sw, se, ridge_e, ridge_w}), pen.quad({ne, nw, ridge_w, ridge_e});
    pen.triangle(se, ne, ridge_e), pen.triangle(nw, sw, ridge_w);
    tiles(sw, se, ridge_w, ridge_e), tiles(se, ne, ridge_e, ridge_e);
    tiles(ne, nw, ridge_e, ridge_w), tiles(nw, sw, ridge_w, ridge_w);
    const double lift = 0.05;
    const int n = sides(7);
    for (const auto& [from, to] :
         {std::pair{sw, ridge_w}, {se, ridge_e}, {ne, ridge_e}, {nw, ridge_w}, {ridge_w, ridge_e}})
      pen.rod(from + dvec3{0, lift, 0}, to + dvec3{0, lift + 0.01, 0}, 0.11, n);
    b.pen(plaster).box({-6.0, eaves + 0.4, -4.2}, {-5.2, eaves + 2.3, -3.4});
    b.pen(tile).box({-6.1, eaves + 2.29, -4.3}, {-5.1, eaves + 2.42, -3.3});
  }

  /// Barrel tiles: half tubes that run down a slope from the ridge to the eaves a-b.
  void tiles(const dvec3& a, const dvec3& c, const dvec3& ridge_a, const dvec3& ridge_c) {
    const double length = glm::length(c - a);
    const int rows = b.rounded(std::min(1.0, 1.6 * b.detail()) * length / 0.26, 3);
    const dvec3 across_slope = (c - a) / length;
    const double ra = glm::dot(ridge_a - a, across_slope), rc = glm::dot(ridge_c - a, across_slope);
    const dvec3 up_slope = ridge_a - a - across_slope * ra;
    const dvec3 normal = glm::normalize(glm::cross(across_slope, up_slope));
    for (int i = 0; i < rows; ++i) {
      const double s = length * (i + 0.5) / rows;
      const double reach = s < ra ? s / ra : s > rc ? (length - s) / (length - rc) : 1.0;
      const dvec3 foot = a + across_slope * s - up_slope * 0.015,
                  head = a + across_slope * s + up_slope * (reach - 0.01);
      const double radius = 0.36 * length / rows;
      b.pen(tile).surface(sides(4), sides(2), {}, [&](double u, double v) {
        const dvec2 on = on_circle(std::numbers::pi * (1.0 - u));
        return glm::mix(foot, head, v) + across_slope * (radius * on.x) + normal * (radius * on.y + 0.002);
      });
    }
  }

  void pergola() {
    const Pen pen = b.pen(wood);
    for (const double x : {east + 3.9, east + 0.5})
      for (int k = 0; k < 3; ++k) pen.box({x - 0.08, -0.3, -4.6 + 3.1 * k}, {x + 0.08, 2.75, -4.44 + 3.1 * k});
    for (const double x : {east + 3.9, east + 0.5}) pen.box({x - 0.05, 2.74, -5.1}, {x + 0.05, 2.95, 2.2});
    const int slats = b.rounded(std::min(1.0, 0.1 + b.detail()) * 46.0, 8);
    for (int i = 0; i < slats; ++i) {
      const double z = -4.9 + 6.9 * i / (slats - 1);
      pen.box({east + 0.3, 2.94, z - 0.022}, {east + 4.3, 3.09, z + 0.022});
    }
    b.pen(paving).box({east + 0.27, -0.2, -5.2}, {east + 4.6, 0.02, 2.3});
    table({east + 2.2, 0.02, -1.3}, 0.0);
  }

  void table(const dvec3& position, double turn_deg) {
    const Pen pen = b.pen(wood, at(position, turn_deg));
    pen.box({-0.5, 0.71, -1.0}, {0.5, 0.75, 1.0});
    for (const double x : {-0.42, 0.42})
      for (const double z : {-0.9, 0.9}) pen.box({x - 0.035, -0.01, z - 0.035}, {x + 0.035, 0.715, z + 0.035});
    for (int i = 0; i < 6; ++i) chair(position, turn_deg, i);
    if (b.keeps(0.3)) {
      const std::vector<dvec2> bowl{{0, 0.755},  {0.1, 0.755},  {0.2, 0.83}, {0.24, 0.9},
                                    {0.23, 0.9}, {0.18, 0.835}, {0, 0.785}};
      b.pen(terracotta, at(position, turn_deg)).lathe(bowl, sides(18));
    }
  }

  void chair(const dvec3& position, double turn_deg, int i) {
    if (!b.keeps(0.4)) return;
    const double side = i % 2 == 0 ? 1.0 : -1.0, wobble = 4.0 * (i % 3) - 4.0;
    const Pen pen =
        b.pen(paint, at(position, turn_deg) * at({0.72 * side, 0, -0.65 + 0.65 * (i / 2)}, 90.0 * side + wobble));
    for (const double x : {-0.2, 0.2}) {
      pen.box({x - 0.02, -0.01, -0.2}, {x + 0.02, 0.44, -0.16});
      pen.box({x - 0.02, -0.01, 0.18}, {x + 0.02, 0.92, 0.22});
    }
    pen.box({-0.23, 0.43, -0.22}, {0.23, 0.46, 0.21});
    for (int k = 0; k < 4; ++k) pen.box({-0.19, 0.56 + 0.09 * k, 0.19}, {0.19, 0.60 + 0.09 * k, 0.21});
  }

  void rooms() {
    const Pen cloth = b.pen(linen), timber = b.pen(wood);
    b.pen(rug).box({-7.6, floor_y - 0.02, -2.6}, {-3.4, floor_y + 0.012, 0.4});
    const auto sofa = [&](const dmat4& place) {
      const Pen pen = cloth.in(place);
      for (int i = 0; i < 3; ++i) {
        const double x = -1.05 + 0.7 * i;
        pen.box({x + 0.01, 0.22, -0.35}, {x + 0.69, 0.44, 0.4});
        pen.hexahedron({dvec3{x + 0.01, 0.43, -0.15}, dvec3{x + 0.69, 0.43, -0.15}, dvec3{x + 0.69, 0.43, -0.37},
                        dvec3{x + 0.01, 0.43, -0.37}},
                       {dvec3{x + 0.01, 0.83, -0.3}, dvec3{x + 0.69, 0.83, -0.3}, dvec3{x + 0.69, 0.83, -0.43},
                        dvec3{x + 0.01, 0.83, -0.43}});
      }
      for (const double x : {-1.25, 1.06}) pen.box({x, 0.1, -0.44}, {x + 0.19, 0.62, 0.39});
      timber.in(place).box({-1.2, 0.06, -0.4}, {1.2, 0.215, 0.36});
    };
    sofa(at({-5.5, floor_y, -2.2}));
    sofa(at({-7.6, floor_y, -0.8}, 90.0));
    table({2.6, floor_y, -2.4}, 90.0);
    timber.box({-6.1, floor_y + 0.30, -1.3}, {-4.7, floor_y + 0.36, -0.5});
    for (const double x : {-5.95, -4.95}) timber.box({x, floor_y - 0.01, -1.2}, {x + 0.1, floor_y + 0.305, -0.6});
    // Stairs to the upper floor, shelves with books, a lamp.
    add_steps(b.pen(wood, at({-2.6, floor_y, -5.55})), 11, 0.25, 0.3, 1.1);
    Random random = b.random(2);
    for (int k = 0; k < 6 && b.keeps(0.3); ++k) {
      timber.box({-8.3, floor_y + 0.1 + 0.4 * k, -5.62}, {-4.6, floor_y + 0.13 + 0.4 * k, -5.3});
      for (double x = -8.2; x < -4.8 && k < 5 && b.keeps(0.5);) {
        const double wide = random.between(0.02, 0.05), high = random.between(0.2, 0.34);
        b.pen(random.below(2) == 0 ? rug : paint)
            .box({x, floor_y + 0.125 + 0.4 * k, -5.55}, {x + wide, floor_y + 0.13 + 0.4 * k + high, -5.35});
        x += wide + 0.003 + (random.below(9) == 0 ? 0.3 : 0.0);
      }
    }
    for (int k = 0; k < 4; ++k)
      timber.box({-8.34 + 1.24 * k, floor_y - 0.01, -5.63}, {-8.30 + 1.24 * k, floor_y + 2.3, -5.29});
    const std::vector<dvec2> shade{{0.12, 1.75}, {0.24, 1.42}, {0.235, 1.42}, {0.115, 1.75}};
    b.pen(linen, translated({-3.4, floor_y, -2.6})).lathe(shade, sides(20));
    b.pen(paint).rod({-3.4, floor_y - 0.01, -2.6}, {-3.4, floor_y + 1.72, -2.6}, 0.014, sides(8));
  }

  void garden() {
    Random random = b.random(3);
    const double leaves = b.detail() * b.detail();
    const auto tree = [&](const dvec3& p, const TreeShape& shape, double count, double leaf_m, uint64_t stream) {
      add_tree(b.pen(bark, translated(p)), b.pen(leaf, translated(p)), b.random(stream), shape,
               b.rounded(leaves * count, 12), leaf_m / std::min(1.5, std::sqrt(std::sqrt(leaves))), b.pieces(7, 3));
    };
    for (int i = 0; i < 8; ++i) {
      const double x = -13.0 + (i % 2) * 0.6, z = -9.0 + 3.1 * i;
      tree({x, -0.1, z}, {random.between(6.4, 8.4), 0.85, 0.3, true}, 1900, 0.40, 10 + uint64_t(i));
    }
    for (int i = 0; i < 7; ++i)
      if (b.keeps(0.2))
        tree({-8.0 + 4.2 * i, -0.1, -11.0}, {random.between(6.0, 8.0), 0.9, 0.3, true}, 1700, 0.40, 30 + uint64_t(i));
    tree({15.2, -0.1, -4.5}, {7.0, 3.2, 2.0}, 4200, 0.34, 50);
    tree({-11.2, -0.1, 20.0}, {8.0, 3.6, 2.4}, 4200, 0.36, 51);
    for (int i = 0; i < 5; ++i) {
      const dvec3 p{i < 3 ? -10.0 + 0.0 * i : 11.7, 0.0, i < 3 ? 7.2 + 3.6 * i : 7.4 + 4.5 * (i - 3)};
      const std::vector<dvec2> pot{{0, -0.02},   {0.24, -0.02}, {0.34, 0.35}, {0.36, 0.52}, {0.41, 0.52},
                                   {0.41, 0.60}, {0.35, 0.60},  {0.33, 0.54}, {0, 0.53}};
      b.pen(terracotta, translated(p)).lathe(pot, sides(20));
      tree(p + dvec3{0, 0.5, 0}, {1.5, 0.55, 0.35}, 500, 0.15, 60 + uint64_t(i));
    }
    for (int i = 0; i < 3 && b.keeps(0.2); ++i) lounger({-1.5 + 2.3 * i, 0.0, 15.6}, 4.0 * i - 5.0);
    parasol({2.1, 0.0, 15.3});
    b.pen(plaster).box({-16.0, -0.3, -13.2}, {24.0, 1.7, -12.9});
    b.pen(tile).box({-16.1, 1.69, -13.3}, {24.1, 1.78, -12.8});
    b.pen(plaster).box({-16.3, -0.3, -13.1}, {-15.98, 1.69, 30.0});
    b.pen(tile).box({-16.4, 1.685, -13.1}, {-15.9, 1.775, 30.1});
  }

  void lounger(const dvec3& p, double turn_deg) {
    const Pen pen = b.pen(wood, at(p, turn_deg)), cloth = b.pen(linen, at(p, turn_deg));
    for (const double x : {-0.32, 0.28}) {
      pen.box({x, 0.26, -0.95}, {x + 0.04, 0.32, 0.95});
      for (const double z : {-0.85, 0.75}) pen.box({x + 0.002, -0.01, z}, {x + 0.038, 0.27, z + 0.06});
    }
    cloth.box({-0.3, 0.315, -0.93}, {0.3, 0.39, 0.35});
    cloth.hexahedron(
        {dvec3{-0.3, 0.33, 0.42}, dvec3{0.3, 0.33, 0.42}, dvec3{0.3, 0.33, 0.36}, dvec3{-0.3, 0.33, 0.36}},
        {dvec3{-0.3, 0.88, 0.92}, dvec3{0.3, 0.88, 0.92}, dvec3{0.3, 0.93, 0.88}, dvec3{-0.3, 0.93, 0.88}});
  }

  void parasol(const dvec3& p) {
    const int ribs = 8;
    const double radius = 1.7, low = 2.05, high = 2.65;
    b.pen(wood).rod(p - dvec3{0, 0.02, 0}, p + dvec3{0, high + 0.12, 0}, 0.025, sides(10));
    b.pen(linen).surface(
        ribs * std::max(1, sides(5) / 2), sides(5), {.wrap_u = true, .pole_end = true}, [&](double u, double v) {
          const double edge = std::abs(2.0 * (u * ribs - std::floor(u * ribs)) - 1.0);  // 1 at a rib
          const double r = radius * (1.0 - v) * (0.94 + 0.06 * edge);
          const dvec2 on = on_circle(2.0 * std::numbers::pi * u);
          return p + dvec3{r * on.x, low + (high - low) * v - 0.06 * (1.0 - edge) * (1.0 - v), -r * on.y};
        });
    for (int i = 0; i < ribs && b.keeps(0.3); ++i) {
      const dvec2 on = on_circle(2.0 * std::numbers::pi * i / ribs);
      b.pen(wood).rod(p + dvec3{0, high - 0.04, 0}, p + dvec3{1.66 * on.x, low - 0.02, 1.66 * on.y}, 0.010, 4);
    }
    b.pen(stone).box(p + dvec3{-0.3, -0.05, -0.3}, p + dvec3{0.3, 0.09, 0.3});
  }
};

}  // namespace

void build_villa(Builder& b) {
  b.set_flat_edge_m(0.6);
  Villa villa{b};
  villa.site();
  villa.house();
  villa.pergola();
  villa.rooms();
  villa.garden();

  b.camera("main", {{12.6, 3.1, 19.0}, {-0.6, 2.2, 2.0}}, 46.0);
  b.path({{{18.0, 5.5, 22.0}, {0.0, 2.5, 0.0}},
          {{2.0, 2.4, 21.0}, {-2.0, 2.5, 0.0}},
          {{-7.5, 1.9, 14.0}, {1.0, 2.0, 3.0}},
          {{-5.0, 2.0, 7.4}, {3.0, 1.8, 3.2}},
          {{1.5, 2.05, 4.0}, {6.0, 1.7, 3.4}},
          {{9.4, 1.9, 5.2}, {9.2, 1.3, -2.0}},
          {{16.0, 3.0, 8.0}, {2.0, 2.4, 0.0}}},
         18.0, true, 52.0);
  b.camera("interior", {{-1.2, floor_y + 1.6, -4.6}, {-6.3, floor_y + 0.7, 0.8}}, 62.0);
  b.sun("morning sun", 139.0, 24.0, {1.0f, 0.93f, 0.82f}, 3.0f);
}

}  // namespace izb::procedural
