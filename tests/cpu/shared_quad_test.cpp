// SPDX-License-Identifier: MIT
// The text of the 32-sample test that GLSL and C++ share: look-up table, edge planes, double-precision definition,
// insertion.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>

#include "reference/exact.h"
#include "shared/coverage.h"
#include "shared/insertion.h"
#include "shared/table.h"
#include "shared_fixture.h"

namespace izb::test {
namespace {

/// Halton (2, 3).
std::vector<glm::vec2> offsets() {
  std::vector<glm::vec2> all;
  const auto inverse = [](unsigned i, unsigned base) {
    double value = 0.0, digit = 1.0 / base;
    for (; i > 0; i /= base, digit /= base) value += digit * (i % base);
    return value - 0.5;
  };
  for (unsigned i = 1; i <= 32; ++i) all.emplace_back(inverse(i, 2), inverse(i, 3));
  return all;
}

uint32_t positive_bits(const glm::dvec3& line) {
  uint32_t bits = 0;
  const std::vector<glm::vec2> all = offsets();
  for (size_t s = 0; s < all.size(); ++s)
    if (line.x + double(all[s].x) * line.y + double(all[s].y) * line.z >= 0.0) bits |= 1u << s;
  return bits;
}

/// A line through or near the pixel.
glm::vec3 random_line(Random& random) {
  const double angle = random.uniform(0.0, 6.28318530718);
  return {random.uniform(-0.7, 0.7), std::cos(angle), std::sin(angle)};
}

TEST(SharedTable, ABinsCentreFallsIntoTheBin) {
  for (const int side : {32, 64, 128})
    for (int entry = 0; entry < side * shared::table_columns(side); ++entry)
      ASSERT_EQ(shared::table_entry(shared::table_line(entry, side), side), entry) << side;
}

TEST(SharedTable, ErrsOnlyNearTheLineAndByAsManyBitsAsMeasuredElsewhere) {
  // Mean wrong bits a half-plane whose line crosses the pixel, for tables over angle and distance: 0.52, 0.26, 0.13.
  const std::pair<int, double> sizes[] = {{32, 0.52}, {64, 0.26}, {128, 0.13}};
  for (const auto& [side, expected] : sizes) {
    Random random(90);
    int lines = 0, wrong = 0;
    for (int i = 0; i < 40000; ++i) {
      const glm::vec3 line = random_line(random);
      const int entry = shared::table_entry(line, side);
      const uint32_t truth = positive_bits(line);
      const uint32_t differing = positive_bits(shared::table_line(entry, side)) ^ truth;
      const int column = entry % shared::table_columns(side);
      if (column == 0 || column == side + 1) {  // the line misses the pixel
        ASSERT_EQ(truth, column == 0 ? 0u : ~0u);
        ASSERT_EQ(differing, 0u);
        continue;
      }
      ++lines;
      wrong += std::popcount(differing);
      const double size = std::abs(line.y) + std::abs(line.z);
      for (int s = 0; s < 32; ++s)
        if (differing >> s & 1u) {
          const glm::vec2 o = offsets()[size_t(s)];
          // Half a bin of offset, and half a bin of direction at both coordinates of the sample.
          ASSERT_LE(std::abs(line.x + o.x * line.y + o.y * line.z) / size, 2.5 / side + 1e-6);
        }
    }
    EXPECT_NEAR(double(wrong) / lines, expected, 0.3 * expected) << side;
  }
}

TEST(SharedTable, OppositeLinesHaveComplementaryBits) {
  Random random(91);
  for (int i = 0; i < 20000; ++i) {
    const glm::vec3 line = random_line(random);
    const int here = shared::table_entry(line, 64), there = shared::table_entry(-line, 64);
    const glm::vec3 a = shared::table_line(here, 64), b = shared::table_line(there, 64);
    ASSERT_LT(glm::length(a + b), 1e-5f);
  }
}

TEST(SharedCoverage, TrianglesThatShareAnEdgeGetOneLine) {
  Random random(92);
  const glm::dvec3 lamp(1.0, 8.0, -3.0);
  const shared::CameraFrame camera = perspective_camera();
  for (int i = 0; i < 2000; ++i) {
    const shared::LightFrame light = make_light(random.direction(), i % 2 ? &lamp : nullptr);
    const glm::vec3 shared_edge[] = {glm::vec3(random.point(5.0)), glm::vec3(random.point(5.0))};
    // The edge's planes in two triangles that name its ends in opposite orders.
    std::vector<shared::EdgePlane> planes;
    for (int k = 0; k < 2; ++k) {
      glm::vec3 v[] = {shared_edge[k], shared_edge[1 - k], glm::vec3(random.point(5.0))};
      std::rotate(v, v + random.below(3), v + 3);
      shared::order_vertices(v[0], v[1], v[2]);
      const shared::QuadTriangle t = shared::make_quad_triangle(camera, light, v[0], v[1], v[2]);
      const auto is_shared = [&](const glm::vec3& a, const glm::vec3& b) {
        return (a == shared_edge[0] && b == shared_edge[1]) || (a == shared_edge[1] && b == shared_edge[0]);
      };
      planes.push_back(is_shared(v[0], v[1]) ? t.edge0 : is_shared(v[1], v[2]) ? t.edge1 : t.edge2);
    }
    ASSERT_EQ(planes[0].first, planes[1].first);
    ASSERT_EQ(planes[0].normal, planes[1].normal);
    ASSERT_EQ(planes[0].turned, planes[1].turned);
  }
}

/// A receiver on the plane of a random triangle, and its micro-quad.
struct Pixel {
  glm::ivec2 px;
  glm::vec4 data;
  glm::vec3 corner[3];
};

Pixel random_pixel(Random& random, const shared::CameraFrame& camera) {
  for (;;) {
    Pixel p;
    p.px = {int(random.below(1920)), int(random.below(1080))};
    const glm::vec3 q = shared::receiver_point(camera, glm::vec2(p.px) + 0.5f, float(random.uniform(3.0, 30.0)));
    glm::vec3 normal(random.direction());
    if (random.below(4) == 0) normal = glm::normalize(normal - q * (glm::dot(normal, q) / glm::dot(q, q)) * 0.999f);
    const glm::vec3 u = glm::normalize(glm::cross(normal, glm::vec3(0.3f, 0.5f, 0.8f))), v = glm::cross(normal, u);
    p.corner[0] = q + u, p.corner[1] = q - 0.6f * u + v, p.corner[2] = q - 0.4f * u - v;
    const glm::dvec3 n = glm::cross(glm::dvec3(p.corner[1]) - glm::dvec3(p.corner[0]),
                                    glm::dvec3(p.corner[2]) - glm::dvec3(p.corner[0]));
    const double t = glm::dot(n, glm::dvec3(p.corner[0])) / glm::dot(n, glm::dvec3(q) / double(-q.z));
    if (!(t > 1.0 && t < 60.0)) continue;
    p.data = shared::micro_quad_data(camera, glm::vec2(p.px) + 0.5f, float(t), p.corner[0], p.corner[1], p.corner[2]);
    return p;
  }
}

TEST(SharedMicroQuad, CornersStayWithinTwiceTheCentresDistanceAndOnThePlane) {
  Random random(93);
  const shared::CameraFrame camera = perspective_camera();
  int shrunk = 0;
  for (int i = 0; i < 5000; ++i) {
    const Pixel p = random_pixel(random, camera);
    const shared::MicroQuad quad = shared::make_micro_quad(camera, p.px, p.data);
    shrunk += shared::scale_of(p.data) < 1.0f;
    const glm::dvec3 a(p.corner[0]);
    const glm::dvec3 n = glm::normalize(glm::cross(glm::dvec3(p.corner[1]) - a, glm::dvec3(p.corner[2]) - a));
    for (int k = 0; k < 4; ++k) {
      const glm::vec3 at = shared::micro_quad_point(quad, shared::corner_offset(k));
      EXPECT_LE(-at.z, 2.0001f * quad.t);
      EXPECT_GE(-at.z, 0.4999f * quad.t);
      EXPECT_LT(std::abs(glm::dot(n, glm::dvec3(at) - a)), 2e-6 * shared::norm1(at));
    }
  }
  EXPECT_GT(shrunk, 5);
}

TEST(SharedCoverage, IsTheExactPredicateAtEachSampleButForTheBias) {
  Random random(94);
  const shared::CameraFrame camera = perspective_camera();
  const glm::dvec3 lamp(1.0, 12.0, -8.0);
  const std::vector<glm::vec2> all = offsets();
  int occluded = 0, partly = 0;
  for (int i = 0; i < 4000; ++i) {
    const Pixel p = random_pixel(random, camera);
    const shared::LightFrame light = make_light(random.direction(), i % 3 == 0 ? &lamp : nullptr);
    const shared::MicroQuad quad = shared::make_micro_quad(camera, p.px, p.data);
    const bool positional = shared::is_positional(light);
    const reference::LightPoint point{positional ? glm::vec3(light.origin) : glm::vec3(light.to_light), positional};
    // Triangles whose shadow has an edge or a corner near the pixel.
    const glm::dvec3 way = positional ? lamp - glm::dvec3(quad.center) : glm::dvec3(glm::vec3(light.to_light));
    const double pixel = shared::pixel_width(camera, quad.t);
    const auto near = [&] {
      return glm::vec3(glm::dvec3(quad.center) + way * random.uniform(0.1, 0.6) + random.point(pixel * 3));
    };
    const glm::vec3 a = near(), b = near(), c = near();
    const shared::QuadPlanes planes = shared::quad_planes(camera, light, a, b, c, p.px, p.data);
    int inside = 0;
    for (const glm::vec2 o : all) {
      const glm::dvec3 at = point_in_double(quad, o);
      const bool ours = shared::occluded_sample(planes, o);
      inside += ours;
      if (ours == reference::occluded_exact(at, {a, b, c}, point)) continue;
      // The float micro-quad here is off by some 1e-7 of its size; and the plane is biased.
      const double slack =
          1e-5 * pixel + 2.0 * shared::quad_bias(camera, quad.center, quad.t, shared::max_norm1(a, b, c), quad.doubt).y;
      bool changes = std::abs(reference::plane_distance(at, {a, b, c}, point)) < slack;
      for (int k = 0; k < 64 && !changes; ++k)
        changes = reference::occluded_exact(at + random.direction() * slack, {a, b, c}, point) == ours;
      EXPECT_TRUE(changes) << i;
    }
    occluded += inside;
    partly += inside > 0 && inside < 32;
  }
  EXPECT_GT(occluded, 2000);
  EXPECT_GT(partly, 200);
}

TEST(SharedCoverage, ABiasAgainstRoundedPlanesIsForThoseAlone) {
  Random random(97);
  const shared::CameraFrame camera = perspective_camera();
  int bent = 0, bent_hidden = 0, crossing = 0, crossing_hidden = 0;
  for (int i = 0; i < 20000; ++i) {
    const Pixel p = random_pixel(random, camera);
    const shared::MicroQuad quad = shared::make_micro_quad(camera, p.px, p.data);
    const glm::dvec3 center(quad.center), own(p.corner[0]);
    glm::dvec3 normal = glm::normalize(glm::cross(glm::dvec3(p.corner[1]) - own, glm::dvec3(p.corner[2]) - own));
    if (quad.extent > 0.15f) continue;  // smaller than any occluder
    const shared::LightFrame light = make_light(normal, nullptr);
    if (glm::dot(normal, glm::dvec3(glm::vec3(light.to_light))) < 0.0) normal = -normal;
    // A triangle around the pixel, turned out of the receiver's plane by little, and lifted by less.
    const glm::dvec3 axis = glm::normalize(glm::cross(normal, random.direction())), side = glm::cross(axis, normal);
    const double angle = std::pow(10.0, random.uniform(-9.0, -2.0)), size = random.uniform(0.5, 2.0);
    const glm::vec2 bias = shared::quad_bias(camera, quad.center, quad.t, shared::norm1(quad.center), quad.doubt);
    const glm::dvec3 lift = normal * (random.uniform(0.0, 1.5) * double(bias.y));
    const auto corner = [&](double x, double y) {
      const double depth = random.uniform(0.9, 1.1);
      return glm::vec3(center + lift + size * depth * (x * axis + y * (side + angle * normal)));
    };
    const glm::vec3 a = corner(0.0, 1.0), b = corner(-0.9, -0.6), c = corner(0.9, -0.6);
    const shared::QuadPlanes planes = shared::quad_planes(camera, light, a, b, c, p.px, p.data);

    const glm::dvec3 n = glm::normalize(glm::cross(glm::dvec3(b) - glm::dvec3(a), glm::dvec3(c) - glm::dvec3(a)));
    const double up = glm::dot(n, normal) < 0.0 ? -1.0 : 1.0;
    const auto height = [&](const glm::vec2& o) { return up * glm::dot(n, glm::dvec3(a) - point_in_double(quad, o)); };
    double lowest = height(shared::corner_offset(0)), highest = lowest;
    for (int k = 1; k < 4; ++k) {
      lowest = std::min(lowest, height(shared::corner_offset(k)));
      highest = std::max(highest, height(shared::corner_offset(k)));
    }
    const double rounding = 0x1p-24 * (double(quad.doubt.y) * double(shared::norm1(quad.center)) +
                                       1.25 * double(shared::max_norm1(a, b, c)));
    const bool is_bent = highest - lowest < rounding;
    if (!is_bent && highest - lowest < 3.0 * rounding) continue;
    const glm::vec2 exact = shared::quad_bias(camera, quad.center, quad.t, shared::max_norm1(a, b, c), quad.doubt);
    const double expected = double(is_bent ? exact.y : exact.x);
    for (const glm::vec2 o : offsets()) {
      const double h = height(o);
      if (std::abs(h - expected) < 0.1 * expected) continue;
      ASSERT_EQ(shared::occluded_sample(planes, o), h > expected) << i << " " << h / expected;
      const bool between = h > double(exact.x) && h < double(exact.y);
      (is_bent ? bent : crossing) += between;
      (is_bent ? bent_hidden : crossing_hidden) += h > expected;
    }
  }
  EXPECT_GT(bent, 10000);
  EXPECT_GT(bent_hidden, 10000);
  EXPECT_GT(crossing, 1000);
  EXPECT_GT(crossing_hidden, 10000);
}

/// A micro-quad on a grid on which it is between a fraction of a texel and some twenty texels wide.
struct OnGrid {
  shared::MicroQuad quad;
  shared::LightFrame light;
  shared::LightWindow window{};
  shared::QuadOnGrid corners;
  int last = 0;

  explicit OnGrid(Random& random) {
    const shared::CameraFrame camera = perspective_camera();
    const Pixel p = random_pixel(random, camera);
    light = make_light(random.direction(), nullptr, 64u << random.below(6));
    quad = shared::make_micro_quad(camera, p.px, p.data);
    const glm::vec3 at = shared::light_uvd(light, shared::light_position(light, quad.center));
    const float scale = float(random.uniform(0.05, 20.0)) / quad.extent;
    const float side = float(light.grid.x);
    window.window = glm::vec4(at.x - float(random.uniform(0.0, 1.0)) * side / scale,
                              at.y - float(random.uniform(0.0, 1.0)) * side / scale, scale, scale);
    window.guard.x = shared::quad_uv_error(light, quad, at) * scale + 8.0f * shared::unit_roundoff * side;
    corners = shared::project_quad(light, window, quad);
    last = int(light.grid.x) - 1;
  }

  /// Where a point of the micro-quad lies, within the grid.
  glm::dvec2 position(const glm::dvec2& offset_px) const {
    const glm::dvec3 q = point_in_double(quad, offset_px);
    const glm::dvec2 uv(glm::dot(glm::dvec3(glm::vec3(light.axis_x)), q),
                        glm::dot(glm::dvec3(glm::vec3(light.axis_y)), q));
    return glm::clamp((uv - glm::dvec2(window.window.x, window.window.y)) * double(window.window.z), 0.0,
                      double(last) + 1.0);
  }
};

std::vector<glm::ivec2> texels_of(const shared::Cover& cover, int most_a_row) {
  std::vector<glm::ivec2> texels;
  for (int i = 0; i < cover.rows.count; ++i) {
    const int row = shared::run_texel(cover.rows, i, cover.last);
    const shared::Run columns = shared::cover_row(cover, row, most_a_row);
    for (int k = 0; k < columns.count; ++k) texels.push_back(shared::cover_texel(cover, row, columns, k));
  }
  return texels;
}

constexpr int no_limit = 0x7fff;

TEST(SharedInsertion, SomeNodeIsWithinReachOfEachPointOfTheMicroQuad) {
  std::vector<size_t> nodes;
  for (const float reach : {0.5f, 0.75f, 1.0f, 1.6f, 4.0f}) {
    Random random(95);
    size_t count = 0;
    for (int i = 0; i < 2000; ++i) {
      const OnGrid on(random);
      const shared::Cover cover = shared::make_cover(on.corners, reach, on.window.guard.x + 0.001f, on.last, no_limit);
      const std::vector<glm::ivec2> texels = texels_of(cover, no_limit);
      count += texels.size();
      for (int k = 0; k < 60; ++k) {
        const glm::dvec2 p = on.position(k < 4 ? glm::dvec2(shared::corner_offset(k))
                                               : glm::dvec2(random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5)));
        ASSERT_TRUE(std::any_of(texels.begin(), texels.end(),
                                [&](const glm::ivec2& texel) {
                                  const glm::dvec2 d = glm::abs(p - (glm::dvec2(texel) + 0.5));
                                  return std::max(d.x, d.y) <= double(reach);
                                }))
            << reach << " " << i << " " << p.x << " " << p.y;
      }
    }
    nodes.push_back(count);
  }
  // A little above what was measured: 11.9, 9.9, 4.5, 2.6 and 1.2 a micro-quad.
  const double most[] = {12.5, 10.3, 4.8, 2.8, 1.3};
  for (size_t i = 0; i < nodes.size(); ++i) EXPECT_LT(double(nodes[i]) / 2000.0, most[i]) << i;
}

TEST(SharedInsertion, NoTexelIsTakenTwiceNorMoreThanAllowed) {
  Random random(96);
  size_t cut = 0;
  for (int i = 0; i < 6000; ++i) {
    const OnGrid on(random);
    const float reach = float(random.uniform(0.5, 2.5));
    const int rows = 1 + int(random.below(8)), columns = 1 + int(random.below(8));
    const shared::Cover cover = shared::make_cover(on.corners, reach, on.window.guard.x + 0.001f, on.last, rows);
    std::vector<glm::ivec2> texels = texels_of(cover, columns);
    ASSERT_LE(cover.rows.count, rows);
    ASSERT_LE(int(texels.size()), rows * columns);
    ASSERT_FALSE(texels.empty());
    cut += cover.rows.count < cover.rows.needed;
    for (const glm::ivec2& texel : texels) {
      ASSERT_EQ(std::count(texels.begin(), texels.end(), texel), 1) << i;
      ASSERT_TRUE(texel.x >= 0 && texel.y >= 0 && texel.x <= on.last && texel.y <= on.last) << i;
    }
  }
  EXPECT_GT(cut, 500u);
}

}  // namespace
}  // namespace izb::test
