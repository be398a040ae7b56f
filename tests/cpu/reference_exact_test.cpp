// SPDX-License-Identifier: MIT
#include "reference/exact.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "reference_fixture.h"

namespace izb::reference {
namespace {

const LightPoint sun_up{{0.0f, 1.0f, 0.0f}, false};
const LightPoint lamp{{0.0f, 4.0f, 0.0f}, true};
const Corners roof{{-1.0f, 2.0f, -1.0f}, {1.0f, 2.0f, -1.0f}, {0.0f, 2.0f, 1.0f}};

TEST(ReferenceExact, QuadOverPlaneCastsItsKnownPolygon) {
  // Corners and light are exact in binary, so the shadow on y = 0 is exactly the square [-1, 1] - 2 (0.5,
  // 0.25).
  Triangles quad;
  add_rectangle(quad, -1.0f, 1.0f, -1.0f, 1.0f, 2.0f);
  const LightPoint slanted{{0.5f, 1.0f, 0.25f}, false};
  Receivers receivers;
  std::vector<bool> inside;
  for (int i = -40; i <= 40; ++i)
    for (int j = -40; j <= 40; ++j) {
      const float x = static_cast<float>(i) / 16.0f, z = static_cast<float>(j) / 16.0f;
      add_receiver(receivers, {x, 0.0f, z});
      inside.push_back(x >= -2.0f && x <= 0.0f && z >= -1.5f && z <= 0.5f);  // the outline counts as inside
    }
  const std::vector<uint32_t> mask = exact_mask(quad, slanted, receivers);
  for (size_t i = 0; i < mask.size(); ++i) EXPECT_EQ(mask[i] == dark, inside[i]) << i;
}

TEST(ReferenceExact, CutQuadHasNoCrackAtAnyVertexOrEdge) {
  // A quad fanned into triangles around 200 times split cells; points lie on the light's line through each
  // vertex and each edge's middle. Coordinates are multiples of 2^-16 below 64, so that all of them are
  // exact.
  Random random(1);
  std::vector<Corners> pieces{{{0, 8, 0}, {16, 8, 0}, {16, 8, 16}}, {{0, 8, 0}, {16, 8, 16}, {0, 8, 16}}};
  const auto exact = [](double v) { return static_cast<float>(std::round(v * 0x1p14) * 0x1p-14); };
  for (int cut = 0; cut < 200; ++cut) {
    const size_t k = static_cast<size_t>(random.uniform(0.0, static_cast<double>(pieces.size())));
    const Corners t = pieces[k];
    const double u = random.uniform(0.2, 0.4), v = random.uniform(0.2, 0.4);
    const glm::dvec3 p = glm::dvec3(t.a) * (1.0 - u - v) + glm::dvec3(t.b) * u + glm::dvec3(t.c) * v;
    const glm::vec3 m{exact(p.x), 8.0f, exact(p.z)};
    pieces[k] = {t.a, t.b, m};
    pieces.push_back({t.b, t.c, m});
    pieces.push_back({t.c, t.a, m});
  }
  Triangles quad;
  for (const Corners& t : pieces) add_triangle(quad, t.a, t.b, t.c);
  const LightPoint slanted{{0.375f, 1.0f, -0.25f}, false};
  const glm::vec3 drop = 8.0f * slanted.xyz_vs;
  Receivers receivers;
  for (const Corners& t : pieces) {
    add_receiver(receivers, t.a - drop);
    add_receiver(receivers, t.c - drop);
    add_receiver(receivers, 0.5f * (t.a + t.b) - drop);
    add_receiver(receivers, 0.5f * (t.b + t.c) - drop);
  }
  for (const uint32_t word : exact_mask(quad, slanted, receivers)) EXPECT_EQ(word, dark);
}

TEST(ReferenceExact, DecidesWhatDoubleCannot) {
  // The edge lies at x = 1/3 (as a float), the point one ulp of double beside it, everything else is large.
  const float x = 1.0f / 3.0f;
  const Corners far{{x, 1e6f, -12345.678f}, {x, 1e6f, 54321.987f}, {2e6f, 1e6f, 7.7f}};
  const double left = std::nextafter(double{x}, 0.0), right = std::nextafter(double{x}, 1.0);
  EXPECT_FALSE(occluded_exact({left, 0.1, 0.3}, far, sun_up));
  EXPECT_TRUE(occluded_exact({x, 0.1, 0.3}, far, sun_up));
  EXPECT_TRUE(occluded_exact({right, 0.1, 0.3}, far, sun_up));
  // The plane passes one ulp above, through, and one ulp below the point.
  EXPECT_TRUE(occluded_exact({0.0, std::nextafter(2.0, 0.0), 0.0}, roof, sun_up));
  EXPECT_FALSE(occluded_exact({0.0, 2.0, 0.0}, roof, sun_up));
  EXPECT_FALSE(occluded_exact({0.0, std::nextafter(2.0, 3.0), 0.0}, roof, sun_up));
}

TEST(ReferenceExact, NeitherCrackNorOrderNearASharedEdge) {
  // Points within an ulp or so of the shadow of an edge that two triangles share: at least one of the two
  // occludes them, and no order of the corners says otherwise. Double alone errs in many of these.
  Random random(21);
  const LightPoint suns[] = {{{0.37f, 1.0f, -0.21f}, false}, {{3.1f, 9.7f, -2.3f}, true}};
  int outside_one = 0;
  for (int i = 0; i < 20000; ++i) {
    const LightPoint& light = suns[i % 2];
    const glm::vec3 up(0, 5, 0), p = random.point(-1.0, 1.0) + up, q = random.point(-1.0, 1.0) + up;
    const glm::vec3 to_light = light.positional ? light.xyz_vs - p : light.xyz_vs;
    const glm::vec3 across = glm::cross(q - p, to_light);
    const Corners left{p, q, p - 2.0f * across}, right{q, p, p + 2.0f * across};
    const glm::dvec3 on_edge = glm::mix(glm::dvec3(p), glm::dvec3(q), random.uniform(0.2, 0.8));
    const glm::dvec3 down = light.positional ? on_edge - glm::dvec3(light.xyz_vs) : -glm::dvec3(light.xyz_vs);
    const glm::dvec3 point = on_edge + random.uniform(0.2, 0.8) * down;
    const bool by_left = occluded_exact(point, left, light), by_right = occluded_exact(point, right, light);
    EXPECT_TRUE(by_left || by_right) << i;
    outside_one += by_left != by_right;
    for (const Corners& t : {left, right}) {
      const bool occluded = occluded_exact(point, t, light);
      EXPECT_EQ(occluded_exact(point, {t.b, t.c, t.a}, light), occluded) << i;
      EXPECT_EQ(occluded_exact(point, {t.c, t.b, t.a}, light), occluded) << i;
      EXPECT_EQ(occluded_exact(point, {t.b, t.a, t.c}, light), occluded) << i;
    }
  }
  EXPECT_GT(outside_one, 10000);
}

TEST(ReferenceExact, WindingDoesNotMatter) {
  for (const glm::dvec3& p : {glm::dvec3(0, 0, 0), glm::dvec3(0.9, 0, 0.9), glm::dvec3(0, 3, 0)})
    EXPECT_EQ(occluded_exact(p, roof, sun_up), occluded_exact(p, {roof.a, roof.c, roof.b}, sun_up));
}

TEST(ReferenceExact, EdgeOnAndDegenerateTrianglesCastNothing) {
  const glm::dvec3 below{0.0, 0.0, 0.0};
  EXPECT_FALSE(occluded_exact(below, {{-1, 1, 0}, {1, 1, 0}, {0, 3, 0}}, sun_up));    // contains the light's direction
  EXPECT_FALSE(occluded_exact(below, {{-1, 1, 0}, {0, 1, 0}, {1, 1, 0}}, sun_up));    // a line
  EXPECT_FALSE(occluded_exact(below, {{0, 1, 0}, {0, 1, 0}, {0, 1, 0}}, sun_up));     // a point
  EXPECT_FALSE(occluded_exact(below, {{-1, 1, 0}, {1, 1, 0}, {0.5f, 3, 0}}, lamp));   // plane contains light and point
  EXPECT_FALSE(occluded_exact({0, 0, 1}, {{-1, 4, 0}, {1, 4, 0}, {0, 4, 1}}, lamp));  // plane contains the light
}

TEST(ReferenceExact, PositionalLightSeesOnlyWhatLiesBetween) {
  const glm::dvec3 p{0.0, 0.0, 0.0};
  const auto at = [](float y) { return Corners{{-1, y, -1}, {1, y, -1}, {0, y, 1}}; };
  EXPECT_TRUE(occluded_exact(p, at(2.0f), lamp));
  EXPECT_TRUE(occluded_exact(p, at(3.999f), lamp));
  EXPECT_FALSE(occluded_exact(p, at(4.0f), lamp));   // at the light: s = 1
  EXPECT_FALSE(occluded_exact(p, at(5.0f), lamp));   // behind the light
  EXPECT_FALSE(occluded_exact(p, at(-1.0f), lamp));  // behind the receiver
  EXPECT_FALSE(occluded_exact(p, at(0.0f), lamp));   // at the receiver: s = 0
  EXPECT_TRUE(occluded_exact(p, at(5.0f), sun_up));  // a sun has no behind
  // The shadow widens with distance: (1.9, 0, -1.9) is in that of a roof half way up, (2.1, 0, -2.1) is not.
  EXPECT_TRUE(occluded_exact({1.9, 0.0, -1.95}, at(2.0f), lamp));
  EXPECT_FALSE(occluded_exact({2.1, 0.0, -2.1}, at(2.0f), lamp));
}

TEST(ReferenceExact, PlaneDistanceIsPositiveTowardsTheLight) {
  EXPECT_DOUBLE_EQ(plane_distance({0.3, 0.5, 0.0}, roof, sun_up), 1.5);
  EXPECT_DOUBLE_EQ(plane_distance({0.3, 2.5, 0.0}, roof, sun_up), -0.5);
  EXPECT_EQ(plane_distance({0.3, 2.0, 0.0}, roof, sun_up), 0.0);
  EXPECT_DOUBLE_EQ(plane_distance({0.3, 0.5, 0.0}, {roof.a, roof.c, roof.b}, lamp), 1.5);
  EXPECT_TRUE(plane_between_exact({5.0, 0.0, 5.0}, roof, sun_up));
  EXPECT_FALSE(plane_between_exact({5.0, 2.0, 5.0}, roof, sun_up));
}

TEST(ReferenceExact, OwnTriangleNeverOccludes) {
  Triangles triangles;
  add_triangle(triangles, roof.a, roof.b, roof.c);
  Receivers receivers;
  add_receiver(receivers, {0.0f, 0.0f, 0.0f}, 1e-3f, 0);
  add_receiver(receivers, {0.0f, 0.0f, 0.0f});
  add_receiver(receivers, {0.0f, 0.0f, 0.0f});
  receivers.classes[2] = PixelClass::culled;
  EXPECT_EQ(exact_mask(triangles, sun_up, receivers), (std::vector<uint32_t>{0, dark, 0}));
  receivers.own_triangle.pop_back();
  EXPECT_THROW(exact_mask(triangles, sun_up, receivers), Error);
}

}  // namespace
}  // namespace izb::reference
