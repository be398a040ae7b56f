// SPDX-License-Identifier: MIT
// A coal power plant, after the one that the University of North Carolina gave to the field: a steel frame filled with
// pipes, ducts, stairs and grating. Nearly all of it is thin, little of it repeats, and much of it stands before much
// else.
#include <algorithm>
#include <vector>

#include "scene/portable_math.h"
#include "scene/procedural/plant_parts.h"
#include "scene/procedural/scenes.h"

namespace izb::procedural {
namespace {

using glm::dmat4;
using glm::dvec2;
using glm::dvec3;

// The boiler house: bays of columns, floors of grating. Front to the south (+z).
constexpr double bay = 7.5, storey = 5.5;
constexpr int bays_x = 6, bays_z = 4, storeys = 8;
constexpr double half_x = 0.5 * bay * bays_x, half_z = 0.5 * bay * bays_z, roof = storey * storeys;

struct Plant {
  Builder& b;
  PlantPalette p{b};
  PlantParts parts{b, p};

  double few() const { return std::min(1.0, b.detail()); }

  /// In pieces: rasterisers place the edges of triangles that reach far out of the picture less well.
  void flat(uint32_t material, const dvec3& low, const dvec3& high, int pieces_x, int pieces_z) {
    b.pen(material).surface(pieces_x, pieces_z, {}, [&](double u, double v) {
      return dvec3{glm::mix(low.x, high.x, u), low.y, glm::mix(high.z, low.z, v)};
    });
  }

  void site() {
    flat(p.concrete, {-170, 0.0, -150}, {170, 0.0, 130}, 8, 7);
    flat(p.earth, {-290, -0.3, -210}, {220, -0.3, 170}, 8, 6);
    flat(p.asphalt, {-170, 0.03, 42}, {170, 0.03, 52}, 16, 1);
    for (int i = 0; i < 40 && b.keeps(0.2); ++i)
      b.pen(p.white).box({-160.0 + 8.0 * i, -0.1, 46.8}, {-157.0 + 8.0 * i, 0.045, 47.1});
  }

  void frame() {
    const Pen steel = b.pen(p.steel);
    for (int i = 0; i <= bays_x; ++i)
      for (int j = 0; j <= bays_z; ++j) {
        const double x = -half_x + bay * i, z = -half_z + bay * j;
        if (b.keeps(0.02)) parts.girder(p.steel, {x, -0.1, z}, {x, roof, z}, 0.46, {0, 0, 1});
        if (b.keeps(0.06)) b.pen(p.concrete).box({x - 0.6, -0.1, z - 0.6}, {x + 0.6, 0.5, z + 0.6});
      }
    for (int f = 1; f <= storeys; ++f) {
      const double y = storey * f;
      if (!b.keeps(0.02)) continue;
      for (int i = 0; i <= bays_x; ++i)
        parts.girder(p.steel, {-half_x + bay * i, y - 0.28, half_z}, {-half_x + bay * i, y - 0.28, -half_z}, 0.36,
                     {0, 1, 0});
      for (int j = 0; j <= bays_z; ++j)
        parts.girder(p.steel, {-half_x, y - 0.30, -half_z + bay * j}, {half_x, y - 0.30, -half_z + bay * j}, 0.36,
                     {0, 1, 0});
      if (!b.keeps(0.05)) continue;
      // Diagonals, on the outside only, so that one can walk through.
      for (int i = 0; i < bays_x; ++i)
        for (const double z : {-half_z, half_z})
          if ((i + f) % 2 == 0)
            steel.beam({-half_x + bay * i, y - storey + 0.1, z}, {-half_x + bay * (i + 1), y - 0.4, z}, 0.14, 0.14,
                       {0, 0, 1});
      for (int j = 0; j < bays_z; ++j)
        for (const double x : {-half_x, half_x})
          if ((j + f) % 2 == 1)
            steel.beam({x, y - storey + 0.1, -half_z + bay * j}, {x, y - 0.4, -half_z + bay * (j + 1)}, 0.14, 0.14,
                       {1, 0, 0});
      const auto boiler = [&](int i, int j) { return i >= 2 && i < 4 && j >= 1 && j < 3; };
      for (int i = 0; i < bays_x; ++i)
        for (int j = 0; j < bays_z; ++j)
          if (!boiler(i, j) && (i + 2 * j + f) % 7 != 0 && f < storeys)
            parts.grating({-half_x + bay * i + 0.25, y, -half_z + bay * j + 0.25},
                          {-half_x + bay * (i + 1) - 0.25, y, -half_z + bay * (j + 1) - 0.25});
      if (f < storeys) {
        parts.railing({-half_x, y, half_z + 0.05}, {half_x, y, half_z + 0.05});
        parts.railing({half_x + 0.05, y, half_z}, {half_x + 0.05, y, -half_z});
        parts.railing({half_x, y, -half_z - 0.05}, {-half_x, y, -half_z - 0.05});
        parts.railing({-half_x - 0.05, y, -half_z}, {-half_x - 0.05, y, half_z});
      }
    }
    b.pen(p.cladding).box({-half_x - 0.6, roof, -half_z - 0.6}, {half_x + 0.6, roof + 0.25, half_z + 0.6});
    parts.corrugated({-half_x - 0.45, storey * 6.0, half_z + 0.4}, {half_x + 0.45, roof + 0.1, half_z + 0.4});
    parts.corrugated({half_x + 0.4, storey * 6.0, half_z + 0.45}, {half_x + 0.4, roof + 0.1, -half_z - 0.45});
  }

  void boiler() {
    const double x = bay, z = bay;
    const Pen casing = b.pen(p.lagging);
    casing.box({-x + 0.6, 6.0, -z + 0.6}, {x - 0.6, roof - 3.0, z - 0.6});
    casing.hexahedron(
        {dvec3{-1.4, 2.2, z - 2.2}, dvec3{1.4, 2.2, z - 2.2}, dvec3{1.4, 2.2, -z + 2.2}, dvec3{-1.4, 2.2, -z + 2.2}},
        {dvec3{-x + 0.8, 6.02, z - 0.8}, dvec3{x - 0.8, 6.02, z - 0.8}, dvec3{x - 0.8, 6.02, -z + 0.8},
         dvec3{-x + 0.8, 6.02, -z + 0.8}});
    // Walls of tubes on all four sides.
    const int tubes = b.rounded(few() * 58, 1);
    for (int side = 0; side < 4; ++side)
      for (int i = 0; i < tubes; ++i) {
        const double s = (i + 0.5) / tubes * 2.0 - 1.0;
        const Pen pen = b.pen(p.rust, turned(1, 90.0 * side));
        const double out = z - 0.55, at_x = s * (x - 0.8);
        parts.pipe(
            pen,
            {{at_x * 0.4, 2.4, out - 2.4}, {at_x, 6.0, out}, {at_x, roof - 3.4, out}, {at_x, roof - 2.2, out - 1.5}},
            0.085, 7);
      }
    const dvec3 drum{0, roof - 1.7, 0};
    parts.vessel(p.lagging, drum - dvec3{x + 1.0, 0, 0}, drum + dvec3{x + 1.0, 0, 0}, 0.95);
  }

  static bool in_boiler(const dvec3& q) { return std::abs(q.x) < bay + 0.4 && std::abs(q.z) < bay + 0.4; }

  /// Runs of pipe that go from floor to floor, bend at right angles and carry flanges and valves.
  void pipes() {
    const int runs = b.rounded(900 * std::min(1.0, 2.0 * b.detail() * b.detail() + 0.9 * b.detail()), 6);
    for (int i = 0; i < runs; ++i) {
      Random random = b.random(100 + uint64_t(i));
      const double r = random.below(6) == 0 ? random.between(0.22, 0.42) : random.between(0.04, 0.16);
      const uint32_t paint = p.pipes[random.below(6)];
      const double x = random.between(-half_x + 0.5, half_x - 0.5), z = random.between(-half_z + 0.5, half_z - 0.5);
      std::vector<dvec3> way{{x, storey * random.below(storeys) + random.between(1.9, 4.6), z}};
      if (in_boiler(way[0])) way[0].x += way[0].x > 0 ? bay + 0.6 : -bay - 0.6;
      const int legs = 3 + int(random.below(5));
      int axis = int(random.below(3)), last_axis = -1;
      for (int k = 0; k < legs; ++k) {
        const dvec3 from = way.back();
        dvec3 to = from;
        to[axis] += random.between(2.5, 9.0) * (random.below(2) == 0 ? 1.0 : -1.0);
        to = glm::clamp(to, dvec3{-half_x + 0.5, 0.6, -half_z + 0.5}, dvec3{half_x - 0.5, roof - 2.0, half_z - 0.5});
        bool clear = axis != last_axis && glm::length(to - from) > 6.0 * r + 0.3;
        for (int n = 1; n <= 8; ++n) clear = clear && !in_boiler(glm::mix(from, to, n / 8.0));
        if (clear) way.push_back(to), last_axis = axis;
        axis = (axis + 1 + int(random.below(2))) % 3;
      }
      if (way.size() > 1) parts.pipe_run(paint, way, r, random);
    }
  }

  /// Racks of parallel pipes between the houses.
  void rack(double x0, double x1, double z, double width, uint64_t stream) {
    Random random = b.random(stream);
    for (double x = x0; x <= x1; x += b.keeps(0.06) ? 6.0 : 24.0) {
      for (const double side : {-0.5, 0.5})
        parts.girder(p.steel, {x, -0.1, z + side * width}, {x, 8.4, z + side * width}, 0.30, {1, 0, 0});
      for (const double y : {5.2, 7.6})
        parts.girder(p.steel, {x, y - 0.16, z - 0.5 * width}, {x, y - 0.16, z + 0.5 * width}, 0.26, {0, 1, 0});
      b.pen(p.steel).beam({x, 5.2, z - 0.5 * width}, {x, 7.4, z + 0.5 * width}, 0.10, 0.10, {1, 0, 0});
    }
    for (const double y : {5.2, 7.6})
      for (double s = -0.5 * width + 0.4; s < 0.5 * width - 0.3;) {
        const double r = random.between(0.06, 0.26);
        s += r;
        if (b.keeps(0.12)) {
          std::vector<dvec3> way{{x0 - 1.0, y + r + 0.01, z + s}};
          if (random.below(3) == 0) {  // an expansion loop
            const double middle = random.between(x0 + 10, x1 - 10);
            for (const dvec2& q : {dvec2{middle, 0}, {middle, 1.3}, {middle + 2.2, 1.3}, {middle + 2.2, 0}})
              way.push_back({q.x, y + r + 0.01 + q.y, z + s});
          }
          way.push_back({x1 + 1.0, y + r + 0.01, z + s});
          parts.pipe_run(p.pipes[random.below(6)], way, r, random);
        }
        s += r + 0.10;
      }
  }

  void turbine_hall() {
    const double x0 = -half_x - 52.0, x1 = -half_x - 6.0, z0 = -16.0, z1 = 16.0, h = 17.0;
    parts.corrugated({x0, 0.0, z1}, {x1, h, z1});
    parts.corrugated({x1, 0.0, z1}, {x1, h, z0});
    parts.corrugated({x1, 0.0, z0}, {x0, h, z0});
    parts.corrugated({x0, 0.0, z0}, {x0, h, z1});
    for (int i = 0; i < 10; ++i) {
      if (!b.keeps(0.05)) continue;
      const double x = glm::mix(x0, x1, i / 9.0);
      parts.truss(p.steel, {x, h + 0.3, z0 - 0.6}, {x, h + 0.3, z1 + 0.6}, 2.3, 14);
    }
    for (int k = 0; k < 9; ++k) {
      const double z = glm::mix(z0 - 0.5, z1 + 0.5, k / 8.0);
      parts.girder(p.steel, {x0 - 0.5, h + 2.72, z}, {x1 + 0.5, h + 2.72, z}, 0.22, {0, 1, 0});
    }
    b.pen(p.cladding).box({x0 - 0.8, h + 2.85, z0 - 0.8}, {x1 + 0.8, h + 3.05, z1 + 0.8});
    for (int i = 0; i < 5; ++i) {
      const dvec3 at{glm::mix(x0, x1, (i + 0.5) / 5), h + 3.0, 0};
      parts.ventilator(at);
    }
    for (int i = 0; i < 6; ++i) parts.door(p.blue, {glm::mix(x0, x1, (i + 0.4) / 6), 0, z1 + 0.16}, 3.0, 3.6);
  }

  void stacks_and_tanks() {
    for (const double x : {-16.0, 16.0}) parts.chimney({x, 0, -62}, 4.6, 118.0);
    for (int i = 0; i < 2; ++i) parts.cooling_tower({-150.0 - 62.0 * i, 0, -62.0 - 40.0 * i}, 25.0, 78.0);
    for (int i = 0; i < 4; ++i)
      parts.tank({half_x + 22.0 + 19.0 * (i % 2), 0, -22.0 + 20.0 * (i / 2)}, 7.2, 10.0 + 2.0 * (i % 2));
    for (int i = 0; i < 3; ++i) parts.silo({half_x + 10.0, 0, -30.0 + 9.0 * i - 14.0}, 3.4, 21.0);
    for (int i = 0; i < 3; ++i) {
      const dvec3 from{-12.0 + 12.0 * i, 3.0, -half_z - 3.5};
      for (int k = 0; k < 2; ++k)
        parts.vessel(p.pipes[k], from + dvec3{0, 4.0 * k, 0}, from + dvec3{8.0, 4.0 * k, 0}, 1.3);
    }
    // Flue ducts and filters between the boiler and the stacks.
    for (const double x : {-12.0, 12.0}) {
      b.pen(p.lagging).box({x - 7.0, 7.0, -44.0}, {x + 7.0, 17.5, -30.0});
      parts.ribs({x - 7.0, 7.0, -44.0}, {x + 7.0, 17.5, -30.0}, 1.2);
      for (const double dx : {-5.5, 0.0, 5.5})
        for (const double z : {-42.5, -31.5})
          parts.girder(p.steel, {x + dx, -0.1, z}, {x + dx, 7.05, z}, 0.4, {0, 0, 1});
      for (const double dx : {-3.5, 3.5})
        b.pen(p.lagging).hexahedron({dvec3{x + dx - 0.5, 3.0, -36.0}, dvec3{x + dx + 0.5, 3.0, -36.0},
                                     dvec3{x + dx + 0.5, 3.0, -38.0}, dvec3{x + dx - 0.5, 3.0, -38.0}},
                                    {dvec3{x + dx - 3.3, 7.02, -30.5}, dvec3{x + dx + 3.3, 7.02, -30.5},
                                     dvec3{x + dx + 3.3, 7.02, -43.5}, dvec3{x + dx - 3.3, 7.02, -43.5}});
      parts.duct({x, 12.0, -29.9}, {x, 22.0, -half_z + 0.4}, 4.2);
      parts.duct({x, 11.0, -44.1}, {x * 1.33, 14.0, -58.0}, 4.0);
    }
  }

  void stairs() {
    for (int f = 0; f < storeys - 1; ++f) {
      const double y = storey * f;
      parts.stair({half_x + 1.2, y, half_z - 1.5 - (f % 2) * 6.6}, f % 2 == 0 ? 90.0 : 270.0, storey, 1.1);
      parts.stair({-half_x - 2.4, y, -half_z + 2.0 + (f % 2) * 6.6}, f % 2 == 0 ? 270.0 : 90.0, storey, 1.1);
      parts.grating({half_x + 0.3, y + storey - 0.02, half_z - 8.6}, {half_x + 2.6, y + storey, half_z - 6.9});
    }
  }

  void conveyor() {
    const dvec3 low{70.0, 2.0, 34.0}, high{half_x - 4.0, 36.0, 0.0};
    parts.truss(p.yellow, low, high, 3.0, 26);
    parts.truss(p.yellow, low + dvec3{-1.0, 0, 2.9}, high + dvec3{-1.0, 0, 2.9}, 3.0, 26);
    b.pen(p.rust).beam(low + dvec3{-0.5, 0.6, 1.45}, high + dvec3{-0.5, 0.6, 1.45}, 1.6, 0.12, {0, 1, 0});
    const double length = glm::length(high - low);
    const int rollers = b.rounded(few() * 90, 2);
    for (int i = 0; i < rollers; ++i) {
      const dvec3 at = glm::mix(low, high, (i + 0.5) / rollers) + dvec3{-0.5, 0.42, 1.45};
      b.pen(p.steel).rod(at - dvec3{0.28, 0, -0.95}, at + dvec3{0.28, 0, -0.95}, 0.08, b.pieces(12, 4));
    }
    for (int i = 1; i < 5; ++i) {
      const dvec3 at = glm::mix(low, high, i / 5.0);
      parts.pylon({at.x - 0.5, 0, at.z + 1.45}, at.y, 0.022 * length + 1.2);
    }
    b.pen(p.cladding).box({66.0, -0.1, 30.0}, {76.0, 6.5, 42.0});
    const int cuts = b.pieces(70, 6);
    b.pen(p.coal).surface(cuts, cuts, {}, [](double u, double v) {
      const double x = 46.0 * (u - 0.5), z = 34.0 * (0.5 - v);
      const double r = std::sqrt(x * x / 1.7 + z * z);
      return dvec3{100.0 + x, std::max(-0.4, 8.5 - 0.62 * r) + 0.5 * fractal_noise({0.5 * x, 0, 0.5 * z}, 3, 9) - 0.2,
                   20.0 + z};
    });
  }
};

}  // namespace

void build_powerplant(Builder& b) {
  b.set_flat_edge_m(1.5);
  Plant plant{b};
  plant.site();
  plant.frame();
  plant.boiler();
  plant.pipes();
  plant.rack(-half_x - 4.0, half_x + 60.0, half_z + 9.0, 6.0, 3);
  plant.rack(-half_x - 50.0, half_x + 4.0, -half_z - 8.5, 5.0, 4);
  plant.turbine_hall();
  plant.stacks_and_tanks();
  plant.stairs();
  plant.conveyor();

  b.camera("main", {{62.0, 19.0, 79.0}, {0.0, 25.0, -8.0}}, 52.0);
  b.camera("inside", {{-17.0, 12.9, 12.6}, {6.0, 13.6, -6.0}}, 65.0);
  b.path({{{120.0, 46.0, 120.0}, {0.0, 24.0, -10.0}},
          {{40.0, 16.0, 62.0}, {0.0, 20.0, 0.0}},
          {{-6.0, 12.6, 34.0}, {4.0, 12.0, 0.0}},
          {{-40.0, 22.0, 40.0}, {0.0, 20.0, 0.0}},
          {{-80.0, 52.0, 40.0}, {-10.0, 20.0, -20.0}},
          {{-20.0, 70.0, -130.0}, {0.0, 20.0, 0.0}},
          {{110.0, 60.0, -60.0}, {0.0, 20.0, 0.0}}},
         20.0, true, 52.0);
  b.sun("afternoon sun", 218.0, 31.0, {1.0f, 0.92f, 0.80f}, 3.0f);
}

}  // namespace izb::procedural
