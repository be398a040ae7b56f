// SPDX-License-Identifier: MIT
// The occlusion prepass: where it says that a texel is covered, the triangle covers all of it, no deeper than it says,
// and what is as far behind as it asks lies higher than every bias behind the triangle's plane. All in double,
// independently.
#include "shared/occluder.h"

#include <gtest/gtest.h>

#include <cmath>

#include "cpu/light_windows.h"

namespace izb::test {
namespace {

double cross2(const glm::dvec2& a, const glm::dvec2& b) {
  return a.x * b.y - a.y * b.x;
}

/// A triangle between the light and the receivers of the window, of about `texels`.
std::array<glm::vec3, 3> triangle_above(Random& random, const Setting& s, double texels) {
  const glm::dvec3 x = glm::vec3(s.light.axis_x), y = glm::vec3(s.light.axis_y), z = glm::vec3(s.light.axis_z);
  const glm::dvec3 origin(glm::vec3(s.light.origin));
  const double side = s.window.guard.y;
  const glm::dvec2 center(random.uniform(0, side), random.uniform(0, side));
  std::array<glm::vec3, 3> corners;
  const double d0 = (random.uniform(-0.5, 0.6) - double(s.window.depth.x)) / double(s.window.depth.y);
  for (glm::vec3& corner : corners) {
    const glm::dvec2 at = center + texels * glm::dvec2(random.uniform(-1, 1), random.uniform(-1, 1));
    const glm::dvec2 uv =
        at / glm::dvec2(s.window.window.z, s.window.window.w) + glm::dvec2(glm::vec2(s.window.window));
    double depth = d0 + random.uniform(-0.05, 0.05) / double(s.window.depth.y);
    if (shared::is_positional(s.light)) {
      depth = -1.0 / std::min(depth, -1e-3);
      corner = glm::vec3(origin + (x * uv.x + y * uv.y + z) * depth);
    } else {
      corner = glm::vec3(x * uv.x + y * uv.y + z * depth);
    }
  }
  return corners;
}

struct Covered {
  int texels = 0, triangles = 0;
};

/// Checks every texel that a rasteriser off by `off` of a texel would fill.
void check(const Setting& s, const std::array<glm::vec3, 3>& v, const glm::dvec2& off, Covered& covered) {
  const shared::Occluder o = shared::make_occluder(s.light, s.window, v[0], v[1], v[2]);
  if (!o.any) return;
  const glm::dvec2 p0(o.p0), p1(o.p1), p2(o.p2);
  const double area = cross2(p1 - p0, p2 - p0), turn = area < 0.0 ? -1.0 : 1.0;
  glm::dvec4 corners[3];
  for (int k = 0; k < 3; ++k) corners[k] = exact_grid(s, glm::dvec3(v[size_t(k)]));
  for (const glm::dvec4& corner : corners) ASSERT_TRUE(!shared::is_positional(s.light) || corner.w > 0.0);
  const glm::dvec2 a(corners[0]), b(corners[1]), c(corners[2]);
  const double true_area = cross2(b - a, c - a), true_turn = true_area < 0.0 ? -1.0 : 1.0;
  const glm::dvec2 low = glm::min(p0, glm::min(p1, p2)), high = glm::max(p0, glm::max(p1, p2));
  const int last = int(s.window.guard.y) - 1;
  const int before = covered.texels;
  for (int y = std::max(0, int(low.y) - 1); y <= std::min(last, int(high.y) + 1); ++y)
    for (int x = std::max(0, int(low.x) - 1); x <= std::min(last, int(high.x) + 1); ++x) {
      const glm::dvec2 center(x + 0.5, y + 0.5), p = center + off;
      const double w0 = cross2(p1 - p, p2 - p) * turn, w1 = cross2(p2 - p, p0 - p) * turn,
                   w2 = cross2(p0 - p, p1 - p) * turn;
      if (w0 < 0 || w1 < 0 || w2 < 0) continue;
      ++covered.texels;
      const double depth = std::clamp((o.p0.z * w0 + o.p1.z * w1 + o.p2.z * w2) / std::abs(area), 0.0, 1.0);
      for (const glm::dvec2& corner : {glm::dvec2(-0.5, -0.5), {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}}) {
        const glm::dvec2 q = center + corner;
        const double e0 = cross2(b - a, q - a) * true_turn, e1 = cross2(c - b, q - b) * true_turn,
                     e2 = cross2(a - c, q - c) * true_turn;
        ASSERT_GT(e0, 0.0);
        ASSERT_GT(e1, 0.0);
        ASSERT_GT(e2, 0.0);
        const double there = (corners[2].z * e0 + corners[0].z * e1 + corners[1].z * e2) / std::abs(true_area);
        ASSERT_GE(depth, std::min(there, 1.0));
        // A point behind it by the margin of some bias: how high over the plane?
        const glm::dvec2 uv =
            q / glm::dvec2(s.window.window.z, s.window.window.w) + glm::dvec2(glm::vec2(s.window.window));
        const double d = (there - double(s.window.depth.x)) / double(s.window.depth.y);
        const bool positional = shared::is_positional(s.light);
        const double z = positional ? -1.0 / d : d;
        const double bias = 1e-3 * std::abs(z);
        // The margin is of the point behind: the least z that is far enough behind, by iteration.
        double behind = z + bias;
        for (int i = 0; i < 200; ++i) {
          const double d_behind = positional ? -1.0 / behind : behind;
          if ((d_behind - d) * double(s.window.depth.y) >=
              double(shared::hidden_margin(s.light, s.window, float(bias), float(behind))))
            break;
          behind += bias;
        }
        const auto at = [&](double depth_ls) {
          const glm::dvec3 ls =
              positional ? glm::dvec3(uv.x * depth_ls, uv.y * depth_ls, depth_ls) : glm::dvec3(uv, depth_ls);
          return glm::dvec3(glm::vec3(s.light.origin)) + glm::dvec3(glm::vec3(s.light.axis_x)) * ls.x +
                 glm::dvec3(glm::vec3(s.light.axis_y)) * ls.y + glm::dvec3(glm::vec3(s.light.axis_z)) * ls.z;
        };
        const glm::dvec3 n =
            glm::normalize(glm::cross(glm::dvec3(v[1]) - glm::dvec3(v[0]), glm::dvec3(v[2]) - glm::dvec3(v[0])));
        ASSERT_GT(std::abs(glm::dot(n, at(behind) - glm::dvec3(v[0]))), bias);
      }
    }
  covered.triangles += covered.texels > before;
}

TEST(SharedOccluder, CoversOnlyWholeTexelsAndNoNearerThanTheTriangle) {
  Random random(71);
  for (const bool positional : {false, true}) {
    Covered covered;
    for (int i = 0; i < 800; ++i) {
      const Setting s = random_setting(random, positional, i % 3 == 0 ? 1000.0 : 5.0);
      for (const double texels : {2.0, 8.0, 30.0}) {
        const auto corners = triangle_above(random, s, texels);
        // Two sub-pixel steps, as far as the guard goes.
        const glm::dvec2 off(random.uniform(-1, 1) / 256.0, random.uniform(-1, 1) / 256.0);
        check(s, corners, off, covered);
        if (HasFatalFailure()) return;
      }
    }
    EXPECT_GT(covered.triangles, 200) << positional;
    EXPECT_GT(covered.texels, 10000) << positional;
  }
}

TEST(SharedOccluder, LeavesOutWhatGrazesTheLightOrIsCutByItsPlane) {
  Random random(72);
  for (int i = 0; i < 300; ++i) {
    Setting s = random_setting(random, i % 2 == 1, 5.0);
    auto corners = triangle_above(random, s, 30.0);
    const glm::vec3 to_light =
        shared::is_positional(s.light) ? glm::vec3(s.light.origin) - corners[0] : glm::vec3(s.light.to_light);
    corners[2] = corners[0] + 0.6f * to_light + 0.01f * (corners[2] - corners[0]);  // nearly along the light
    EXPECT_FALSE(shared::make_occluder(s.light, s.window, corners[0], corners[1], corners[2]).any);
    if (!shared::is_positional(s.light)) continue;
    corners = triangle_above(random, s, 30.0);
    corners[1] = glm::vec3(s.light.origin) - 0.1f * (corners[1] - glm::vec3(s.light.origin));
    EXPECT_FALSE(shared::make_occluder(s.light, s.window, corners[0], corners[1], corners[2]).any);
  }
}

}  // namespace
}  // namespace izb::test
