// SPDX-License-Identifier: MIT
// Conservative rasterisation: whatever texel a point of a triangle projects to, the footprint covers its centre, at a
// depth that is not behind the point. The points are projected in double, independently of the shared text.
#include <gtest/gtest.h>

#include <cmath>

#include "shared/footprint.h"
#include "shared_fixture.h"

namespace izb::test {
namespace {

struct Setting {
  shared::LightFrame light;
  shared::LightWindow window;
};

/// A window over random receivers, made by the stage's own text.
Setting random_setting(Random& random, bool positional, double reach) {
  const glm::dvec3 lamp = random.point(reach);
  Setting s;
  s.light = make_light(random.direction(), positional ? &lamp : nullptr, 64u << random.below(6));
  shared::ReceiverBounds bounds{glm::uvec4(~0u), glm::uvec4(0u), glm::uvec4(0u)};
  const glm::dvec3 center = random.point(reach);
  for (int i = 0; i < 50; ++i) {
    glm::dvec3 p = center + random.point(reach * 0.2);
    if (positional) {  // inside a cone of 45 degrees
      const glm::dvec3 z = glm::vec3(s.light.axis_z), x = glm::vec3(s.light.axis_x), y = glm::vec3(s.light.axis_y);
      const double far = reach * random.uniform(0.05, 1.0);
      p = lamp + z * far + x * far * random.uniform(-0.7, 0.7) + y * far * random.uniform(-0.7, 0.7);
    }
    const glm::vec3 p_vs(p);
    const glm::vec3 p_ls = shared::light_position(s.light, p_vs);
    if (positional && p_ls.z <= 0.0f) continue;
    const glm::vec3 uvd = shared::light_uvd(s.light, p_ls);
    for (int k = 0; k < 3; ++k) {
      bounds.low[k] = std::min(bounds.low[k], shared::ordered_from_float(uvd[k]));
      bounds.high[k] = std::max(bounds.high[k], shared::ordered_from_float(uvd[k]));
    }
    bounds.slack.x = std::max(bounds.slack.x, shared::ordered_from_float(shared::uv_error(s.light, p_vs, p_ls)));
    bounds.slack.y = std::max(bounds.slack.y, shared::ordered_from_float(shared::d_error(s.light, p_vs, p_ls)));
    ++bounds.slack.z;
  }
  s.window = shared::make_window(s.light, bounds);
  return s;
}

/// Grid position and depth in double, through the window's own numbers; z of the light space in w.
glm::dvec4 exact_grid(const Setting& s, const glm::dvec3& p_vs) {
  const glm::dvec3 p = p_vs - glm::dvec3(glm::vec3(s.light.origin));
  const glm::dvec3 ls(glm::dot(glm::dvec3(glm::vec3(s.light.axis_x)), p),
                      glm::dot(glm::dvec3(glm::vec3(s.light.axis_y)), p),
                      glm::dot(glm::dvec3(glm::vec3(s.light.axis_z)), p));
  const bool positional = shared::is_positional(s.light);
  const glm::dvec3 uvd = positional ? glm::dvec3(ls.x / ls.z, ls.y / ls.z, -1.0 / ls.z) : ls;
  const glm::dvec4 w(s.window.window);
  return {(uvd.x - w.x) * w.z, (uvd.y - w.y) * w.w, double(s.window.depth.x) + double(s.window.depth.y) * uvd.z, ls.z};
}

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

void check(uint32_t seed, bool positional) {
  Random random(seed);
  int covered = 0, triangles = 0, wrong = 0, behind = 0;
  for (int i = 0; i < 30'000; ++i) {
    const double reach = std::pow(10.0, random.uniform(-1.0, 3.0));
    const Setting s = random_setting(random, positional, reach);
    if (s.window.guard.y == 0.0f) continue;
    const double size = reach * std::pow(10.0, random.uniform(-4.0, random.below(10) ? 0.3 : 4.0));
    const glm::dvec3 center = random.point(reach);
    glm::dvec3 corner[3];
    for (glm::dvec3& v : corner) v = center + random.point(size);
    if (random.below(3) == 0)
      corner[2] = glm::mix(corner[0], corner[1], random.uniform(0, 1)) + random.point(size * 1e-4);
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

TEST(SharedFootprint, CostsLittleMoreThanTheTexelsItMust) {
  // Fat and thin triangles of a few texels: the polygon may not be larger than the dilated box, nor than needed by far.
  Random random(13);
  const shared::LightFrame light = make_light({0, 0, -1}, nullptr, 256);
  shared::LightWindow window{};
  window.window = glm::vec4(0, 0, 1, 1);
  window.depth = glm::vec4(0.5f, 0.001f, 0, 0);
  window.guard = glm::vec4(0, 1, 0, 0);
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
    s.window.guard = glm::vec4(0, 1, 0, 0);
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
