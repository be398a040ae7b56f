// SPDX-License-Identifier: MIT
// A walled town on a hill under its citadel, after the citadels of games: many flat faces of every size, windows,
// crenels and tiles, streets in which shadows end on walls.
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

constexpr double town_radius = 92.0, keep_radius = 25.0;

/// The hill: flat on top, where the citadel stands, and down to the plain in terraces.
double ground(double x, double z) {
  const double r = std::sqrt(x * x + z * z);
  const double hill = 26.0 * (1.0 - smooth_step(keep_radius + 4.0, 150.0, r));
  const double rough = smooth_step(town_radius, town_radius + 60.0, r);
  return hill + (0.5 + 6.0 * rough) * fractal_noise({0.016 * x, 0.3, 0.016 * z}, 4, 11);
}

struct Town {
  Builder& b;
  uint32_t soil = b.material("soil", {0.27f, 0.25f, 0.14f});
  uint32_t rock = b.material("rampart stone", {0.50f, 0.45f, 0.37f});
  uint32_t plaster[4]{
      b.material("ochre plaster", {0.62f, 0.50f, 0.34f}), b.material("white plaster", {0.72f, 0.67f, 0.58f}),
      b.material("rose plaster", {0.60f, 0.42f, 0.33f}), b.material("grey plaster", {0.54f, 0.50f, 0.44f})};
  uint32_t tile[3]{b.material("red tile", {0.45f, 0.19f, 0.12f}), b.material("brown tile", {0.37f, 0.20f, 0.14f}),
                   b.material("slate", {0.22f, 0.24f, 0.28f})};
  uint32_t timber = b.material("timber", {0.21f, 0.14f, 0.09f});
  uint32_t glass = b.material("window", {0.06f, 0.08f, 0.10f});
  uint32_t leaf = b.material("leaf", {0.14f, 0.21f, 0.08f}, true);
  uint32_t bark = b.material("bark", {0.22f, 0.17f, 0.12f});
  uint32_t banner = b.material("banner", {0.50f, 0.08f, 0.07f}, true);

  double few() const { return std::min(1.0, b.detail()); }

  void land() {
    const int cuts = b.pieces(120, 12);
    b.pen(soil).surface(cuts, cuts, {}, [](double u, double v) {
      // Finer where the town is.
      const double a = 2.0 * u - 1.0, c = 1.0 - 2.0 * v;
      const double x = 320.0 * a * (0.35 + 0.65 * a * a), z = 320.0 * c * (0.35 + 0.65 * c * c);
      return dvec3{x, ground(x, z), z};
    });
  }

  /// Merlons along the top of a wall that heads for +x from the origin, its outer face at z = 0.
  void crenels(const Pen& pen, double length, double y, double step) {
    if (!b.keeps(0.25)) return;
    const int count = std::max(1, int(length / step));
    for (int i = 0; i < count; ++i) {
      const double x = length * (i + 0.25) / count, w = 0.55 * length / count;
      pen.box({x, y - 0.02, -0.62}, {x + w, y + 1.05, -0.02});
    }
  }

  /// A gable house: front to +z, `w` along x, `d` along z; y = 0 is the floor.
  void house(const dmat4& place, double w, double d, int floors, Random& random) {
    const double storey = 2.7, h = storey * floors + 0.3, foot = -3.2, jut = random.below(3) == 0 ? 0.35 : 0.0;
    const uint32_t walls = plaster[random.below(4)], roof = tile[random.below(8) < 7 ? random.below(2) : 2];
    const bool fine = b.keeps(0.30);
    const int across_front = std::max(1, int(w / 2.4)), across_side = std::max(1, int(d / 3.2));
    std::vector<Opening> front, side;
    for (int f = 0; f < floors; ++f) {
      for (int i = 0; i < across_front && fine; ++i) {
        const double x = w * (i + 0.5) / across_front;
        if (f == 0 && i == across_front / 2)
          front.push_back({x - 0.5, x + 0.5, -0.2, 2.0});
        else
          front.push_back({x - 0.4, x + 0.4, storey * f + 0.95, storey * f + 2.1});
      }
      for (int i = 0; i < across_side && fine && f > 0; ++i) {
        const double x = d * (i + 0.5) / across_side;
        side.push_back({x - 0.35, x + 0.35, storey * f + 0.95, storey * f + 2.0});
      }
    }
    const dmat4 south = place * at({-w / 2, 0, d / 2}), east = place * at({w / 2, 0, d / 2 - 0.3}, 90),
                north = place * at({w / 2, 0, -d / 2}, 180), west = place * at({-w / 2, 0, -d / 2 + 0.3}, 270);
    for (const dmat4& face : {south, north}) facade(face, walls, w, foot, h, front);
    for (const dmat4& face : {east, west}) facade(face, walls, d - 0.6, foot, h, side);
    if (fine && random.below(3) == 0) beams(south, w, h, floors, storey);
    gable(place, walls, roof, w, d, h, 0.42 + 0.4 * random.between(0, 1), random);
    if (jut > 0.0 && fine && floors > 1) balcony(place, w, d, storey);
  }

  void facade(const dmat4& face, uint32_t walls, double length, double foot, double h,
              const std::vector<Opening>& openings) {
    add_wall(b.pen(walls, face), length, foot, h, 0.3, openings);
    for (const Opening& o : openings) {
      const Pen pane = b.pen(glass, face), frame = b.pen(timber, face);
      const double z = -0.2;
      pane.quad(
          {dvec3{o.left, o.bottom, z}, dvec3{o.right, o.bottom, z}, dvec3{o.right, o.top, z}, dvec3{o.left, o.top, z}});
      if (b.keeps(0.75)) {
        const double x = 0.5 * (o.left + o.right), y = 0.5 * (o.bottom + o.top);
        frame.box({x - 0.03, o.bottom - 0.01, -0.21}, {x + 0.03, o.top + 0.01, -0.15});
        frame.box({o.left - 0.01, y - 0.025, -0.208}, {o.right + 0.01, y + 0.025, -0.155});
      }
      if (o.bottom > 0.0 && b.keeps(0.5))
        b.pen(rock, face).box({o.left - 0.1, o.bottom - 0.12, -0.05}, {o.right + 0.1, o.bottom + 0.01, 0.10});
      if (o.bottom > 0.0 && b.keeps(0.8))
        for (const double x : {o.left - 0.42, o.right + 0.04})
          frame.box({x, o.bottom + 0.02, 0.01}, {x + 0.38, o.top - 0.02, 0.055});
    }
  }

  void beams(const dmat4& face, double w, double h, int floors, double storey) {
    const Pen pen = b.pen(timber, face);
    for (int f = 1; f <= floors; ++f) pen.box({-0.03, storey * f - 0.08, -0.02}, {w + 0.03, storey * f + 0.12, 0.07});
    for (const double x : {0.0, w}) pen.box({x - 0.09, 0.0, -0.03}, {x + 0.09, h, 0.06});
    pen.beam({0.1, storey + 0.1, 0.02}, {1.1, h - 0.1, 0.02}, 0.08, 0.16, {0, 1, 0.001});
    pen.beam({w - 0.1, storey + 0.1, 0.02}, {w - 1.1, h - 0.1, 0.02}, 0.08, 0.16, {0, 1, 0.001});
  }

  void balcony(const dmat4& place, double w, double d, double storey) {
    const Pen pen = b.pen(timber, place);
    const double x = 0.36 * w, z = d / 2, y = storey + 0.05;
    pen.box({-x, y - 0.12, z - 0.1}, {x, y, z + 0.95});
    pen.box({-x, y + 0.86, z + 0.87}, {x, y + 0.93, z + 0.94});
    const int bars = b.rounded(few() * 2.0 * x / 0.22, 2);
    for (int i = 0; i <= bars; ++i) {
      const double p = -x + 0.03 + (2.0 * x - 0.06) * i / bars;
      pen.box({p - 0.02, y - 0.01, z + 0.885}, {p + 0.02, y + 0.87, z + 0.925});
    }
  }

  void gable(const dmat4& place, uint32_t walls, uint32_t roof, double w, double d, double h, double pitch,
             Random& random) {
    const double rise = pitch * d, over = 0.4, drop = over * 2.0 * pitch, thick = 0.14;
    const Pen pen = b.pen(walls, place);
    for (const double s : {-1.0, 1.0}) {  // the gables
      const dvec3 a{s * w / 2, h, s * d / 2}, c{s * w / 2, h, -s * d / 2}, top{s * w / 2, h + rise, 0};
      const dvec3 in{-s * 0.3, 0, 0};
      pen.triangle(a, c, top), pen.triangle(c + in, a + in, top + in);
    }
    for (const double s : {-1.0, 1.0}) {
      const auto at_edge = [&](double x, double y) { return dvec3{s * x, h + y, s * (d / 2 + over)}; };
      const double half = w / 2 + 0.35;
      const dvec3 eave_l = at_edge(-half, -drop), eave_r = at_edge(half, -drop), top_l{-s * half, h + rise, 0},
                  top_r{s * half, h + rise, 0};
      const dvec3 up{0, thick, 0};
      b.pen(roof, place).hexahedron({eave_l, eave_r, top_r, top_l}, {eave_l + up, eave_r + up, top_r + up, top_l + up});
      const int rows = b.keeps(0.5) ? b.rounded(few() * 2.0 * half / 0.5, 3) : 0;
      for (int i = 0; i < rows; ++i) {  // ribs of tiles
        const double t = (i + 0.5) / rows;
        b.pen(roof, place)
            .beam(glm::mix(eave_l, eave_r, t) + up * 1.1, glm::mix(top_l, top_r, t) + up * 1.1, 0.14, 0.13, {0, 1, 0});
      }
    }
    b.pen(roof, place)
        .beam({-w / 2 - 0.37, h + rise + thick, 0}, {w / 2 + 0.37, h + rise + thick, 0}, 0.3, 0.2, {0, 1, 0});
    if (b.keeps(0.4)) {
      const double x = random.between(-0.35, 0.35) * w, z = random.between(0.1, 0.25) * d;
      b.pen(rock, place).box({x - 0.3, h, z - 0.3}, {x + 0.3, h + rise + 0.9, z + 0.3});
      b.pen(roof, place).box({x - 0.37, h + rise + 0.89, z - 0.37}, {x + 0.37, h + rise + 1.02, z + 0.37});
    }
  }

  void tower(const dvec3& base, double radius, double height, bool roofed, double foot) {
    const Pen pen = b.pen(rock, translated(base));
    const int sides = b.pieces(26, 6);
    const double r = radius, h = height;
    const std::vector<dvec2> body{{r * 1.12, foot},    {r, 0.3 * h},        {r, h - 1.2},        {r * 1.02, h - 1.1},
                                  {r * 1.18, h - 0.3}, {r * 1.18, h + 0.4}, {r * 1.18, h + 0.4}, {r * 0.9, h + 0.4},
                                  {r * 0.9, h + 0.4},  {r * 0.9, h - 0.1},  {r * 0.9, h - 0.1},  {0, h - 0.1}};
    const std::vector<dvec2> plain{{r * 1.12, foot}, {r, h + 0.4}, {r, h + 0.4}, {0, h + 0.4}};
    pen.lathe(b.keeps(0.2) ? body : plain, sides);
    const int merlons = std::max(6, int(r * 5.5));
    for (int i = 0; i < merlons && b.keeps(0.25); ++i)
      pen.in(turned(1, 360.0 * i / merlons)).box({-0.34, h + 0.38, r * 0.92}, {0.34, h + 1.4, r * 1.16});
    for (int i = 0; i < 9 && b.keeps(0.6); ++i) {  // slits, dark and framed
      const dmat4 turn = turned(1, 40.0 * i + 15.0);
      const double y = h * (0.35 + 0.2 * (i % 3));
      b.pen(glass, translated(base) * turn).box({-0.09, y, r - 0.3}, {0.09, y + 1.2, r + 0.035});
      pen.in(turn).box({-0.2, y - 0.16, r - 0.3}, {0.2, y - 0.01, r + 0.09});
    }
    if (!roofed) return;
    const std::vector<dvec2> cone{{r * 1.05, h + 0.2},  {r * 1.05, h + 2.6}, {r * 1.05, h + 2.6},   {r * 1.42, h + 2.2},
                                  {r * 1.42, h + 2.35}, {r * 0.95, h + 3.6}, {0, h + 3.6 + 2.4 * r}};
    pen.lathe(std::span(cone).first(2), sides);
    b.pen(tile[2], translated(base)).lathe(std::span(cone).subspan(3), sides);
    const double y = h + 3.5 + 2.4 * r;
    b.pen(timber, translated(base)).rod({0, y - 0.4, 0}, {0, y + 2.4, 0}, 0.05, 5);
    b.pen(banner, translated(base)).surface(b.pieces(8, 2), b.pieces(4, 1), {}, [&](double u, double v) {
      return dvec3{0.03 + 1.7 * u, y + 1.3 + v * (0.95 - 0.45 * u) + 0.22 * u, 0.16 * sine(7.0 * u + base.x) * u};
    });
  }

  /// A ring of towers and the walls between them.
  void rampart(double radius, int towers, double height, double thickness, double first_deg) {
    for (int i = 0; i < towers; ++i) {
      const auto corner = [&](int k) {
        const dvec2 on = on_circle((first_deg + 360.0 * k / towers) * degree);
        const double x = radius * on.x, z = -radius * on.y;
        return dvec3{x, ground(x, z), z};
      };
      const dvec3 p = corner(i), q = corner(i + 1), flat = dvec3{q.x - p.x, 0, q.z - p.z};
      tower(p, 3.1, height + 4.5, i % 3 == 0, -6.0);
      const double length = glm::length(flat), y = 0.5 * (p.y + q.y) + height;
      const dvec3 x = flat / length;
      const dmat4 face{glm::dvec4{x, 0}, glm::dvec4{0, 1, 0, 0}, glm::dvec4{glm::cross(x, dvec3{0, 1, 0}), 0},
                       glm::dvec4{p.x, 0, p.z, 1}};
      const bool gate = i == 4 * towers / 6;
      std::vector<Opening> openings;
      if (gate) openings.push_back({length / 2 - 2.0, length / 2 + 2.0, y - height - 1.5, y - height + 4.2});
      const Pen pen = b.pen(rock, face);
      add_wall(pen, length, std::min(p.y, q.y) - 6.0, y, thickness, openings);
      crenels(pen, length, y, 1.5);
      for (double s = 3.6; s < length - 3.6; s += 3.0)
        if (b.keeps(0.35)) pen.box({s, std::min(p.y, q.y) - 5.0, -0.1}, {s + 0.7, y - 1.4, 0.45});
    }
  }

  void citadel() {
    const double y = ground(0, 0);
    rampart(keep_radius, 8, 9.0, 1.6, 11.0);
    const Pen pen = b.pen(rock, translated({0, y, 0}));
    const auto block = [&](double x0, double x1, double z0, double z1, double top) {
      const double w = x1 - x0, d = z1 - z0;
      std::vector<Opening> front, side;
      for (int row = 0; row < int((top - 4.0) / 4.2) && b.keeps(0.3); ++row) {
        for (double s = 1.6; s < w - 1.6; s += 2.6) front.push_back({s, s + 0.9, 3.0 + 4.2 * row, 5.1 + 4.2 * row});
        for (double s = 1.6; s < d - 2.6; s += 2.6) side.push_back({s, s + 0.9, 3.0 + 4.2 * row, 5.1 + 4.2 * row});
      }
      const dmat4 centre = translated({0, y, 0});
      const std::pair<dmat4, double> faces[]{{at({x0, 0, z1}), w},
                                             {at({x1, 0, z1 - 0.8}, 90), d - 1.6},
                                             {at({x1, 0, z0}, 180), w},
                                             {at({x0, 0, z0 + 0.8}, 270), d - 1.6}};
      for (int i = 0; i < 4; ++i) {
        const auto& [turn, length] = faces[i];
        const Pen face = b.pen(rock, centre * turn);
        const auto& openings = i % 2 == 0 ? front : side;
        add_wall(face, length, -3.0, top, 0.8, openings);
        crenels(face, length, top, 1.4);
        for (const Opening& o : openings) {
          b.pen(glass, centre * turn)
              .quad({dvec3{o.left, o.bottom, -0.5}, dvec3{o.right, o.bottom, -0.5}, dvec3{o.right, o.top, -0.5},
                     dvec3{o.left, o.top, -0.5}});
          if (b.keeps(0.6)) face.box({o.left - 0.15, o.top, -0.1}, {o.right + 0.15, o.top + 0.25, 0.14});
        }
      }
      pen.box({x0 + 0.7, top - 1.0, z0 + 0.7}, {x1 - 0.7, top - 0.4, z1 - 0.7});
    };
    block(-9, 9, -8, 7, 17), block(-5, 6, -5, 4.5, 28), block(9.2, 15, -6, 5, 11), block(-15, -9.2, -4, 6, 13);
    for (const dvec3& p : {dvec3{-9, y, 7}, dvec3{9, y, 7}, dvec3{9, y, -8}, dvec3{-9, y, -8}})
      tower(p, 2.4, 21, true, -3.0);
    for (const dvec3& p : {dvec3{-5, y, 4.5}, dvec3{6, y, -5}}) tower(p, 1.7, 33, true, -3.0);
  }

  void church(const dvec3& p, double turn_deg) {
    const dmat4 place = at(p, turn_deg);
    Random random = b.random(900);
    gable(place, plaster[1], tile[0], 20, 10, 8.0, 0.75, random);
    std::vector<Opening> windows;
    for (int i = 0; i < 5; ++i) windows.push_back({2.0 + 3.6 * i, 3.1 + 3.6 * i, 2.4, 6.4});
    facade(place * at({-10, 0, 5}), plaster[1], 20, -4, 8, windows);
    facade(place * at({10, 0, -5}, 180), plaster[1], 20, -4, 8, windows);
    facade(place * at({10, 0, 4.7}, 90), plaster[1], 9.4, -4, 8, {});
    facade(place * at({-10, 0, -4.7}, 270), plaster[1], 9.4, -4, 8, {{3.7, 5.7, -0.5, 3.2}});
    for (int i = 0; i < 6; ++i)
      for (const double s : {-1.0, 1.0})
        b.pen(rock, place).box({-9.9 + 3.6 * i, -3, s * 5.4 - 0.7}, {-9.2 + 3.6 * i, 6.2, s * 5.4 + 0.7});
    const dmat4 belfry = place * translated({-12.5, 0, 0});
    const std::vector<Opening> bell{{1.6, 3.4, 15.0, 18.5}};
    for (int i = 0; i < 4; ++i)
      add_wall(b.pen(rock, belfry * turned(1, 90.0 * i) * translated({-2.5 + 0.6 * (i % 2), 0, 2.5})),
               i % 2 == 0 ? 5.0 : 3.8, -4, 20, 0.6, i % 2 == 0 ? bell : std::vector<Opening>{});
    for (int i = 0; i < 4; ++i)
      b.pen(tile[2], belfry * turned(1, 90.0 * i)).triangle({-2.9, 19.9, 2.9}, {2.9, 19.9, 2.9}, {0, 29, 0});
    b.pen(rock, belfry).box({-2.7, 19.6, -2.7}, {2.7, 19.95, 2.7});
  }

  void houses() {
    const int rings = 6;
    const double lanes[]{33.5, 43.0, 52.5, 62.0, 71.5, 81.5};
    uint64_t stream = 1000;
    for (int ring = 0; ring < rings; ++ring) {
      const double r = lanes[ring];
      for (double turn = 3.0 * ring; turn < 360.0 + 3.0 * ring - 4.0;) {
        Random random = b.random(++stream);
        const double w = random.between(4.6, 8.2), d = random.between(6.0, 7.6), gap = random.below(7) == 0 ? 3.2 : 0.5;
        const double span = (w + gap) / r / degree;
        const double angle = turn + span / 2;
        turn += span;
        const dvec2 on = on_circle(angle * degree);
        const double x = r * on.x, z = -r * on.y;
        const bool square = std::abs(x + 6.0) < 17.0 && z > 40.0 && z < 66.0;  // the market and the church
        const bool street = std::abs(on.y * r) < 2.8 || std::abs(on.x * r - 0.12 * (r - 30.0)) < 2.8;
        if (square || street) continue;
        const double y = std::max(ground(x + 2.5 * on.y, z + 2.5 * on.x), ground(x - 2.5 * on.y, z - 2.5 * on.x));
        if (!b.keeps(0.15)) continue;
        house(at({x, y, z}, angle + 90.0 + random.between(-3, 3)), w, d, 2 + int(random.below(3) > 0), random);
      }
    }
    church({-4.0, ground(-4, 53), 53.0}, 8.0);
  }

  void woods() {
    const int count = b.rounded(160 * std::min(1.0, 0.02 + b.detail()), 5);
    for (int i = 0; i < count; ++i) {
      Random random = b.random(5000 + uint64_t(i));
      const dvec2 on = on_circle(random.between(0, 6.2831));
      const double r =
          i % 5 == 0 ? random.between(84, 89) : 100.0 + 90.0 * random.between(0, 1) * random.between(0.2, 1);
      const double x = r * on.x, z = -r * on.y;
      const double h = random.between(5, 9);
      const dmat4 place = translated({x, ground(x, z) - 0.1, z});
      const double leaves = b.detail() * b.detail() * 520.0;
      add_tree(b.pen(bark, place), b.pen(leaf, place), random, {h, 0.36 * h, 0.25 * h, i % 3 == 0},
               b.rounded(leaves, 16), std::clamp(0.75 / b.detail(), 0.4, 2.4), b.pieces(6, 3));
    }
  }
};

}  // namespace

void build_town(Builder& b) {
  b.set_flat_edge_m(1.5);
  Town town{b};
  town.land();
  town.rampart(town_radius, 18, 7.0, 1.8, 5.0);
  town.citadel();
  town.houses();
  town.woods();

  b.camera("main", {{58.0, 45.0, 142.0}, {0.0, 24.0, 10.0}}, 39.0);
  b.path({{{150.0, 60.0, 120.0}, {0.0, 18.0, 0.0}},
          {{40.0, 34.0, 118.0}, {0.0, 18.0, 20.0}},
          {{-14.0, 31.0, 76.0}, {0.0, 25.0, 10.0}},
          {{-66.0, 38.0, 50.0}, {0.0, 24.0, 0.0}},
          {{-110.0, 48.0, -30.0}, {0.0, 20.0, 0.0}},
          {{-10.0, 62.0, -150.0}, {0.0, 16.0, 0.0}},
          {{130.0, 70.0, -60.0}, {0.0, 16.0, 0.0}}},
         20.0, true, 45.0);
  b.camera("roofs", {{-34.0, 34.0, 66.0}, {0.0, 24.0, 22.0}}, 46.0);
  b.sun("afternoon sun", 243.0, 26.0, {1.0f, 0.90f, 0.75f}, 3.0f);
}

}  // namespace izb::procedural
