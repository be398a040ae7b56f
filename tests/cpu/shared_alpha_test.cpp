// SPDX-License-Identifier: MIT
// Alpha masks by the text of the shaders, against a formula of the test's own.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "shared/hits.h"
#include "shared_fixture.h"

namespace izb::test {
namespace {

using namespace shared;

constexpr uint wraps[] = {wrap_repeat, wrap_mirrored, wrap_clamp};

AlphaMap map_of(int width, int height, uint wrap_u, uint wrap_v, bool nearest) {
  return {{width, height}, {wrap_u, wrap_v}, 0, nearest, 1.0f, 127.5f};
}

/// Texel n of an endless row.
long expected_texel(long n, long size, uint wrap) {
  if (wrap == wrap_clamp) return std::clamp(n, 0L, size - 1);
  const long period = wrap == wrap_mirrored ? 2 * size : size;
  const long k = (n % period + period) % period;
  return k < size ? k : period - 1 - k;
}

double expected_alpha(const AlphaMap& map, const std::vector<uint8_t>& texels, const glm::dvec2& at) {
  const auto texel = [&](long x, long y) {
    return double(texels[size_t(expected_texel(y, map.size.y, map.wrap.y) * map.size.x +
                                expected_texel(x, map.size.x, map.wrap.x))]);
  };
  if (map.nearest) return texel(std::lround(std::floor(at.x)), std::lround(std::floor(at.y)));
  const double x = at.x - 0.5, y = at.y - 0.5;
  const long i = std::lround(std::floor(x)), j = std::lround(std::floor(y));
  const double fx = x - double(i), fy = y - double(j);
  return (1 - fy) * ((1 - fx) * texel(i, j) + fx * texel(i + 1, j)) +
         fy * ((1 - fx) * texel(i, j + 1) + fx * texel(i + 1, j + 1));
}

bool passes(AlphaMap map, const std::vector<uint8_t>& texels, const glm::dvec2& at, double cutoff) {
  const AlphaTexels t = alpha_texels(map, at);
  map.cutoff = float(cutoff);
  return passes_cutoff(map,
                       {texels.at(size_t(t.index.x)), texels.at(size_t(t.index.y)), texels.at(size_t(t.index.z)),
                        texels.at(size_t(t.index.w))},
                       t.between);
}

TEST(SharedAlpha, IsTheFilteredAlphaForEverySizeWrapAndFilter) {
  Random random(1);
  for (const auto& [width, height] : {std::pair{1, 1}, {1, 4}, {2, 2}, {3, 5}, {16, 7}})
    for (const uint wrap_u : wraps)
      for (const uint wrap_v : wraps)
        for (const bool nearest : {false, true}) {
          std::vector<uint8_t> texels(size_t(width) * size_t(height));
          for (uint8_t& t : texels) t = uint8_t(random.below(256));
          const AlphaMap map = map_of(width, height, wrap_u, wrap_v, nearest);
          for (int i = 0; i < 500; ++i) {
            glm::dvec2 at(random.uniform(-3.0 * width, 4.0 * width), random.uniform(-3.0 * height, 4.0 * height));
            if (i % 7 == 0) at.x = std::floor(at.x) + 0.5;  // a texel's centre
            const double alpha = expected_alpha(map, texels, at);
            // Brackets it from both sides.
            EXPECT_TRUE(passes(map, texels, at, alpha - 1e-3)) << at.x << " " << at.y;
            EXPECT_FALSE(passes(map, texels, at, alpha + 1e-3)) << at.x << " " << at.y;
          }
        }
}

TEST(SharedAlpha, OnBordersTheNearestTexelIsTheOneThatBegins) {
  const std::vector<uint8_t> row{0, 255, 0, 255};
  for (const uint wrap : wraps) {
    const AlphaMap map = map_of(4, 1, wrap, wrap, true);
    for (int n = -9; n < 14; ++n)
      EXPECT_EQ(passes(map, row, {double(n), 0.5}, 127.5), row[size_t(expected_texel(n, 4, wrap))] == 255) << n;
  }
}

TEST(SharedAlpha, NoCoordinateReadsOutsideTheMap) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const uint wrap : wraps)
    for (const bool nearest : {false, true})
      for (const double x : {0.0, -0.0, 5.0, 10.0, -1e-300, -0.5, 4.9999999999999999, 1e9 + 0.5, -1e9, 1e30, -1e30,
                             infinity, -infinity, std::numeric_limits<double>::quiet_NaN()}) {
        const AlphaTexels t = alpha_texels(map_of(5, 5, wrap, wrap, nearest), {x, x});
        for (int i = 0; i < 4; ++i) {
          EXPECT_GE(t.index[i], 0) << x;
          EXPECT_LT(t.index[i], 25) << x;
        }
      }
}

TEST(SharedAlpha, AnAlphaOfN255thsPassesACutoffOfN255thsAndNoHigherOne) {
  for (int n = 0; n <= 255; ++n) {
    const float cutoff = float(n) / 255.0f;
    const AlphaMap map{{1, 1}, {0, 0}, 0, false, 1.0f, cutoff * 255.0f};
    EXPECT_TRUE(passes_cutoff(map, glm::vec4(float(n)), {0.25f, 0.7f})) << n;
    if (n > 0) {
      EXPECT_FALSE(passes_cutoff(map, glm::vec4(float(n - 1)), {0.25f, 0.7f})) << n;
    }
  }
}

TEST(SharedAlpha, TheFactorOfTheMaterialCounts) {
  AlphaMap map = map_of(1, 1, 0, 0, false);
  map.factor = 0.5f;
  EXPECT_TRUE(passes_cutoff(map, glm::vec4(255.0f), {0, 0}));
  EXPECT_FALSE(passes_cutoff(map, glm::vec4(254.0f), {0, 0}));
}

TEST(SharedAlpha, HitsLieWhereTheLineMeetsTheTriangle) {
  Random random(2);
  for (int i = 0; i < 2000; ++i) {
    glm::vec3 v[3];
    for (glm::vec3& p : v) p = glm::vec3(random.point(3.0) + glm::dvec3(0, 0, -8));
    const glm::dvec3 position = random.point(2.0) + glm::dvec3(0, 12, -8);
    const LightFrame light = make_light(random.direction(), i % 2 ? &position : nullptr);
    const TexelCorners corners{{1.0, 2.0}, {64.0, -5.0}, {-7.0, 100.0}};
    const double wb = random.uniform(0, 1), wc = random.uniform(0, 1 - wb);
    const glm::dvec3 hit = glm::dvec3(v[0]) * (1 - wb - wc) + glm::dvec3(v[1]) * wb + glm::dvec3(v[2]) * wc;
    const glm::dvec3 way = light.origin.w != 0.0f ? glm::dvec3(light.origin) - hit : glm::dvec3(light.to_light);
    const glm::dvec3 n = glm::normalize(glm::cross(glm::dvec3(v[1] - v[0]), glm::dvec3(v[2] - v[0])));
    if (std::abs(glm::dot(n, glm::normalize(way))) < 0.1) continue;
    const glm::vec3 p(hit - way * random.uniform(0.1, 2.0));
    const glm::dvec2 expected = corners.a * (1 - wb - wc) + corners.b * wb + corners.c * wc;
    const glm::dvec2 found = texel_of_weights(corners, light_weights(light, p, v[0], v[1], v[2]));
    // p is rounded to floats.
    EXPECT_LT(glm::length(found - expected), 0.01 + 1e-4 * glm::length(expected)) << i;
  }
}

TEST(SharedAlpha, OverAMicroQuadTheHitsAreThoseOfItsPoints) {
  Random random(3);
  const CameraFrame camera = perspective_camera();
  for (int i = 0; i < 500; ++i) {
    const glm::dvec3 position = random.point(2.0) + glm::dvec3(0, 9, -6);
    const LightFrame light = make_light(glm::dvec3(0.2, -1, 0.1), i % 2 ? &position : nullptr);
    const glm::ivec2 px(int(random.below(1920)), int(random.below(1080)));
    const glm::vec4 quad =
        micro_quad_data(camera, glm::vec2(px) + 0.5f, 10.0f, {-9, -2, -4}, {9, -2.5, -5}, {1, -2, -22});
    glm::vec3 v[3];
    for (glm::vec3& p : v) p = glm::vec3(random.point(2.0) + glm::dvec3(0, 2, -9));
    const TexelCorners corners{{1.0, 2.0}, {64.0, -5.0}, {-7.0, 100.0}};
    const HitPlanes hits = hit_planes(quad_planes(camera, light, v[0], v[1], v[2], px, quad), corners);
    const MicroQuad m = make_micro_quad(camera, px, quad);
    const glm::vec2 o(random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5));
    const glm::dvec3 d = light.origin.w != 0.0f ? glm::dvec3(light.origin) : glm::dvec3(light.to_light);
    const glm::dvec3 n = glm::cross(glm::dvec3(v[1] - v[0]), glm::dvec3(v[2] - v[0]));
    if (std::abs(glm::dot(glm::normalize(n), glm::normalize(d))) < 0.1) continue;
    const glm::vec3 p(point_in_double(m, o));
    const glm::dvec2 by_point = texel_of_weights(corners, light_weights(light, p, v[0], v[1], v[2]));
    EXPECT_LT(glm::length(texel_of_sample(hits, o) - by_point), 0.01 + 1e-4 * glm::length(by_point)) << i;
  }
}

}  // namespace
}  // namespace izb::test
