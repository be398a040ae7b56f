// SPDX-License-Identifier: MIT
// Conservative rasterisation: whatever texel a point of a triangle projects to, the footprint covers its centre, at a
// depth that is not behind the point. The points are projected in double, independently of the shared text.
#include <gtest/gtest.h>

#include <cmath>

#include "cpu/light_windows.h"
#include "shared/footprint.h"

namespace izb::test {
namespace {

double side(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& p) {
  return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}

bool inside(const shared::Footprint& f, const glm::dvec2& p) {
  const glm::dvec2 q0(f.p0), q1(f.p1), q2(f.p2), q3(f.p3);
  const auto in_triangle = [&](const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    const double s0 = side(a, b, p), s1 = side(b, c, p), s2 = side(c, a, p);
    return (s0 >= 0 && s1 >= 0 && s2 >= 0) || (s0 <= 0 && s1 <= 0 && s2 <= 0);
  };
  return in_triangle(q0, q1, q2) || (f.count == 4 && in_triangle(q1, q2, q3));
}

/// Depth that the rasteriser interpolates at p, from the polygon's first three corners.
double depth_at(const shared::Footprint& f, const glm::dvec2& p) {
  const glm::dvec2 a(f.p0), b(f.p1), c(f.p2);
  const double area = side(a, b, c);
  return (f.p0.z * side(b, c, p) + f.p1.z * side(c, a, p) + f.p2.z * side(a, b, p)) / area;
}

/// A third are needles, 10^thinness times the size wide.
void random_corners(Random& random, const glm::dvec3& center, double size, double thinness, glm::dvec3 (&corner)[3]) {
  for (glm::dvec3& v : corner) v = center + random.point(size);
  if (random.below(3) == 0)
    corner[2] = glm::mix(corner[0], corner[1], random.uniform(0, 1)) + random.point(size * std::pow(10.0, thinness));
}

void check(uint32_t seed, bool positional) {
  Random random(seed);
  int covered = 0, triangles = 0, wrong = 0, behind = 0;
  for (int i = 0; i < 30'000; ++i) {
    const double reach = std::pow(10.0, random.uniform(-1.0, 3.0));
    const Setting s = random_setting(random, positional, reach);
    if (s.window.guard.y == 0.0f) continue;
    const double size = reach * std::pow(10.0, random.uniform(-4.0, random.below(10) ? 0.3 : 4.0));
    glm::dvec3 corner[3];
    random_corners(random, random.point(reach), size, -4.0, corner);
    const glm::vec3 a(corner[0]), b(corner[1]), c(corner[2]);
    const shared::Footprint f = shared::make_footprint(s.light, s.window, a, b, c, 0.5f);
    ++triangles;
    const double grid = s.light.grid.x;
    for (int k = 0; k < 40; ++k) {
      const double u = std::sqrt(random.uniform(0, 1)), v = random.uniform(0, 1);
      const glm::dvec3 p = (1 - u) * glm::dvec3(a) + u * (1 - v) * glm::dvec3(b) + u * v * glm::dvec3(c);
      const glm::dvec4 g = exact_grid(s, p);
      if (positional && g.w <= 0.0) continue;
      // Receivers' own positions may be off by the window's guard.
      const glm::dvec2 at =
          glm::dvec2(g) + double(s.window.guard.x) * glm::dvec2(random.uniform(-1, 1), random.uniform(-1, 1));
      if (!(at.x >= 0 && at.y >= 0 && at.x < grid && at.y < grid)) continue;
      ++covered;
      const glm::dvec2 center_px = glm::floor(at) + 0.5;
      const bool hit = f.count > 0 && inside(f, center_px) && center_px.x >= f.box.x && center_px.y >= f.box.y &&
                       center_px.x <= f.box.z && center_px.y <= f.box.w;
      wrong += !hit;
      if (hit) behind += std::max(depth_at(f, center_px), 0.0) > std::max(g.z, 0.0);
    }
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_EQ(behind, 0);
  EXPECT_GT(covered, triangles);  // enough triangles reach the grid
}

TEST(SharedFootprint, CoversEveryTexelThatADirectionalLightsTriangleTouches) {
  check(11, false);
}

TEST(SharedFootprint, CoversEveryTexelThatASpotsTriangleTouchesAlsoAcrossTheLightsPlane) {
  check(12, true);
}

/// Hardware that rasterises conservatively by itself, as far as its extensions tell: vertices snapped to either of the
/// next 256ths of a texel, every texel whose square of half side `square` touches the triangle, and the plane and its
/// offset in single precision from the window's corner.
struct Hardware {
  glm::vec3 v[3];
  float slope_x, slope_y, corner_depth;
  bool degenerate;

  Hardware(const Setting& s, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, Random& random) {
    const glm::vec3* p_vs[3] = {&a, &b, &c};
    const float half_side = 0.5f * float(s.light.grid.x);
    for (int i = 0; i < 3; ++i) {
      v[i] = shared::hardware_vertex(s.light, s.window, *p_vs[i]);
      for (int k = 0; k < 2; ++k) {
        const float clip = v[i][k] * (1.0f / half_side) - 1.0f;
        v[i][k] = (std::floor((clip * half_side + half_side) * 256.0f) + float(random.below(2))) / 256.0f;
      }
    }
    const glm::vec3 e1 = v[1] - v[0], e2 = v[2] - v[0];
    degenerate = double(e1.x) * e2.y == double(e1.y) * e2.x;
    const float det = e1.x * e2.y - e1.y * e2.x;
    slope_x = (e1.z * e2.y - e2.z * e1.y) / det;
    slope_y = (e2.z * e1.x - e1.z * e2.x) / det;
    corner_depth = v[0].z - slope_x * v[0].x - slope_y * v[0].y;
  }

  bool touches(const glm::dvec2& center, double square) const {
    const auto apart = [&](const glm::dvec2& n) {
      const double reach = square * (std::abs(n.x) + std::abs(n.y)), at = glm::dot(n, center);
      const double d0 = glm::dot(n, glm::dvec2(v[0])), d1 = glm::dot(n, glm::dvec2(v[1])),
                   d2 = glm::dot(n, glm::dvec2(v[2]));
      return std::min({d0, d1, d2}) > at + reach || std::max({d0, d1, d2}) < at - reach;
    };
    for (int i = 0; i < 3; ++i) {
      const glm::dvec2 edge = glm::dvec2(v[(i + 1) % 3]) - glm::dvec2(v[i]);
      if (apart({-edge.y, edge.x})) return false;
    }
    return !apart({1, 0}) && !apart({0, 1});
  }

  double depth(const glm::dvec2& center, float square) const {
    const float plane = corner_depth + slope_x * float(center.x) + slope_y * float(center.y);
    return plane + shared::hardware_offset_factor(square) * std::max(std::abs(slope_x), std::abs(slope_y));
  }
};

void check_hardware(uint32_t seed, bool positional) {
  Random random(seed);
  int left = 0, taken = 0, points = 0, wrong = 0, behind = 0;
  for (int i = 0; i < 100'000; ++i) {
    const double reach = std::pow(10.0, random.uniform(-1.0, 3.0));
    const Setting s = random_setting(random, positional, reach);
    if (s.window.guard.y == 0.0f) continue;
    const double size = reach * std::pow(10.0, random.uniform(-4.0, random.below(10) ? 0.3 : 2.0));
    const glm::dvec3 center = random.point(reach);
    glm::dvec3 corner[3];
    random_corners(random, center, size, random.uniform(-3.0, 0.0), corner);
    if (random.below(4) == 0) {  // facing the light: no slope hides an error of the depth
      const glm::dvec3 z = glm::vec3(s.light.axis_z);
      for (glm::dvec3& v : corner) v -= z * glm::dot(z, v - center);
    }
    const glm::vec3 a(corner[0]), b(corner[1]), c(corner[2]);
    const float dilation = random.below(2) ? 0.5f : 1.0f;
    const shared::Footprint f = shared::make_footprint(s.light, s.window, a, b, c, dilation);
    if (f.count == 0) continue;
    const bool trusted = f.square <= dilation + 0.25f;
    ++(trusted ? taken : left);
    if (!trusted) continue;
    const Hardware hardware(s, a, b, c, random);
    EXPECT_FALSE(hardware.degenerate);
    for (int k = 0; k < 40; ++k) {
      const double u = std::sqrt(random.uniform(0, 1)), v = k % 2 ? random.uniform(0, 1) : 0.0;
      const glm::dvec3 p = (1 - u) * glm::dvec3(a) + u * (1 - v) * glm::dvec3(b) + u * v * glm::dvec3(c);
      const glm::dvec4 g = exact_grid(s, p);
      if (!(g.x >= 0 && g.y >= 0 && g.x < s.light.grid.x && g.y < s.light.grid.x)) continue;
      // The furthest from p that a texel's centre may be which must not miss it.
      const double far = double(s.window.guard.x) + double(dilation);
      const glm::dvec2 at = glm::dvec2(g) + far * (2.0 * glm::dvec2(random.below(2), random.below(2)) - 1.0);
      ++points;
      wrong += !hardware.touches(at, f.square);
      behind += std::max(hardware.depth(at, f.square), 0.0) > std::max(g.z, 0.0);
    }
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_EQ(behind, 0);
  EXPECT_GT(points, 50'000);
  EXPECT_GT(taken, left);  // the geometry shader's share is the smaller
}

TEST(SharedFootprint, HardwareCoversWhatItIsTrustedWithNoDeeperThanTheTriangle) {
  check_hardware(15, false);
  check_hardware(16, true);
}

TEST(SharedFootprint, FourShiftedCopiesTouchWhatADilatedTriangleTouches) {
  Random random(17);
  int touched = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Setting s{make_light({0, 0, -1}, nullptr, 64), {}};
    Hardware hardware(s, {}, {}, {}, random);
    for (glm::vec3& v : hardware.v) v = glm::vec3(random.point(3.0));
    if (!hardware.touches({0.5, 0.5}, 0.75)) continue;
    ++touched;
    bool any = false;
    for (const glm::dvec2& shift : {glm::dvec2(-0.25, -0.25), {0.25, -0.25}, {-0.25, 0.25}, {0.25, 0.25}})
      any |= hardware.touches(glm::dvec2(0.5) - shift, 0.5 + 1e-9);
    EXPECT_TRUE(any);
  }
  EXPECT_GT(touched, 1000);
}

TEST(SharedFootprint, CostsLittleMoreThanTheTexelsItMust) {
  // Fat and thin triangles of a few texels: the polygon may not be larger than the dilated box, nor than needed by far.
  Random random(13);
  const shared::LightFrame light = make_light({0, 0, -1}, nullptr, 256);
  shared::LightWindow window{};
  window.window = glm::vec4(0, 0, 1, 1);
  window.depth = glm::vec4(0.5f, 0.001f, 0, 0);
  window.guard = glm::vec4(0, 256, 0, 0);
  double needle_area = 0.0, needle_box = 0.0;
  for (int i = 0; i < 1000; ++i) {
    const glm::dvec3 x = glm::vec3(light.axis_x), y = glm::vec3(light.axis_y);
    const auto at = [&](double u, double v) { return glm::vec3(x * u + y * v); };
    const double angle = random.uniform(0.2, 1.3), length = 60.0;
    const glm::vec3 a = at(100, 100), b = at(100 + length * std::cos(angle), 100 + length * std::sin(angle));
    const shared::Footprint f = shared::make_footprint(light, window, a, b, b + at(0.1, -0.1), 0.5f);
    ASSERT_GT(f.count, 0);
    const glm::dvec2 p0(f.p0), p1(f.p1), p2(f.p2), p3(f.p3);
    needle_area += 0.5 * std::abs(side(p0, p1, p2)) + (f.count == 4 ? 0.5 * std::abs(side(p1, p2, p3)) : 0.0);
    needle_box += (f.box.z - f.box.x) * (f.box.w - f.box.y);
  }
  EXPECT_LT(needle_area, 0.15 * needle_box);
}

TEST(SharedFootprint, ATriangleAcrossTheLightsPlaneCostsTheBoxOfItsPartInFront) {
  // The texels whose centre's ray from the lamp hits the triangle, found one by one, against the footprint's box.
  Random random(14);
  const glm::dvec3 lamp(0, 0, 0);
  double boxes = 0.0, needed = 0.0;
  int crossing = 0;
  for (int i = 0; i < 400; ++i) {
    Setting s{make_light(random.direction(), &lamp, 64), {}};
    s.window.window = glm::vec4(-1, -1, 32, 32);  // 45 degrees to each side
    s.window.depth = glm::vec4(0.5f, 0.001f, 0, 0);
    s.window.guard = glm::vec4(0, 64, 0, 0);
    const glm::dvec3 z = glm::vec3(s.light.axis_z), center = random.point(1.0);
    const glm::dvec3 a = center + random.point(2.0), b = center + random.point(2.0), c = center + random.point(2.0);
    const double nearest = std::min({glm::dot(a, z), glm::dot(b, z), glm::dot(c, z)});
    if (nearest > 0.0) continue;
    const glm::dvec3 x = glm::vec3(s.light.axis_x), y = glm::vec3(s.light.axis_y);
    glm::dvec2 low(1e9), high(-1e9);
    for (int v = 0; v < 64; ++v)
      for (int u = 0; u < 64; ++u) {
        const glm::dvec3 ray = z + x * ((u + 0.5) / 32 - 1) + y * ((v + 0.5) / 32 - 1);
        const glm::dvec3 weights = glm::inverse(glm::dmat3(a, b, c)) * ray;  // all positive: hit, in front
        if (glm::any(glm::lessThan(weights, glm::dvec3(0)))) continue;
        low = glm::min(low, glm::dvec2(u, v)), high = glm::max(high, glm::dvec2(u + 1, v + 1));
      }
    const shared::Footprint f =
        shared::make_footprint(s.light, s.window, glm::vec3(a), glm::vec3(b), glm::vec3(c), 0.5f);
    if (f.count > 0) boxes += (f.box.z - f.box.x) * (f.box.w - f.box.y);
    if (low.x > high.x) continue;
    ++crossing;
    needed += (high.x - low.x) * (high.y - low.y);
  }
  EXPECT_GT(crossing, 50);
  // A margin of 2.5 texels on each side of boxes of some 40: a quarter more.
  EXPECT_LT(boxes, 1.3 * needed);
}

}  // namespace
}  // namespace izb::test
