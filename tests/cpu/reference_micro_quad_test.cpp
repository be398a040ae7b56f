// SPDX-License-Identifier: MIT
#include "reference/micro_quad.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "reference/points.h"
#include "reference_fixture.h"

namespace izb::reference {
namespace {

constexpr int width_px = 640, height_px = 480;

class MicroQuads : public testing::TestWithParam<bool> {
 protected:
  MicroQuads() {
    Camera camera;
    camera.orthographic = GetParam();
    camera.ymag = 3.0;
    rays = pixel_rays(camera, width_px, height_px);
    const glm::dvec3 right = rays.direction_dx + rays.origin_dx, down = rays.direction_dy + rays.origin_dy;
    steps = {{right.x, -down.y}, !GetParam()};
  }

  // The t of the ray through pixel position px where it meets the plane of p, p + e1, p + e2: Cramer's rule.
  double meets(const glm::dvec2& px, const glm::dvec3& p, const glm::dvec3& e1, const glm::dvec3& e2) const {
    const glm::dvec3 o = rays.origin_at(px.x, px.y), d = rays.direction_at(px.x, px.y);
    return glm::determinant(glm::dmat3(p - o, e1, e2)) / glm::determinant(glm::dmat3(d, e1, e2));
  }

  PixelRays rays;
  PixelSteps steps;
};

// A pixel and the plane through a point on its ray.
struct Case {
  glm::dvec2 px;
  glm::dvec3 point, e1, e2;
  MicroQuad quad;

  Case(Random& random, const PixelRays& rays, const PixelSteps& steps, double grazing)
      : px(std::floor(random.uniform(0, width_px)), std::floor(random.uniform(0, height_px))) {
    point = rays.origin_at(px.x, px.y) + random.uniform(0.5, 50.0) * rays.direction_at(px.x, px.y);
    e1 = random.point(-1.0, 1.0), e2 = random.point(-1.0, 1.0);
    // Towards the direction of sight: seen at ever smaller angles.
    if (grazing > 0.0) e1 = glm::mix(e1, rays.direction_at(px.x, px.y), 1.0 - grazing);
    quad = micro_quad(point, tangent_slopes(point, glm::cross(e1, e2), steps), steps);
  }
};

TEST_P(MicroQuads, SamplesLieWhereTheirRaysMeetThePlane) {
  Random random(31);
  int whole = 0, shrunk = 0;
  for (int i = 0; i < 2000; ++i) {
    const double grazing = i % 2 ? std::exp2(random.uniform(-16.0, 0.0)) : 0.0;
    const Case c(random, rays, steps, grazing);
    ++(c.quad.shrink < 1.0 ? shrunk : whole);
    for (const glm::dvec2& offset : random_offsets(random)) {
      const glm::dvec3 sample = c.quad.at(offset);
      const glm::dvec2 at = c.px + c.quad.shrink * glm::dvec2(offset.x, -offset.y);
      const double t = meets(at, c.point, c.e1, c.e2);
      const glm::dvec3 expected = rays.origin_at(at.x, at.y) + t * rays.direction_at(at.x, at.y);
      // What double rounds, times the slope of the plane against the ray.
      EXPECT_LE(glm::length(sample - expected), 1e-11 / c.quad.shrink * glm::length(c.point)) << i;
      EXPECT_NEAR(glm::dot(glm::normalize(glm::cross(c.e1, c.e2)), sample - c.point), 0.0,
                  1e-13 * glm::length(c.point));
    }
  }
  EXPECT_GT(whole, 500);
  EXPECT_GT(shrunk, 100);
}

TEST_P(MicroQuads, NoCornerIsNearerThanHalfOrFurtherThanTwice) {
  Random random(32);
  int tight = 0;
  for (int i = 0; i < 4000; ++i) {
    const Case c(random, rays, steps, std::exp2(random.uniform(-16.0, 0.0)));
    double furthest = 0.0;
    for (const glm::dvec2 corner : {glm::dvec2(-0.5, -0.5), {0.5, -0.5}, {-0.5, 0.5}, {0.5, 0.5}}) {
      const double t = c.quad.at(corner).z / c.point.z;
      EXPECT_GE(t, 0.5 - 1e-12);
      EXPECT_LE(t, 2.0 + 1e-12);
      furthest = std::max(furthest, GetParam() ? std::abs(t - 1.0) : std::abs(1.0 / t - 1.0));
    }
    // Shrunk no more than that takes, and not at all where nothing is beyond.
    if (c.quad.shrink < 1.0) {
      EXPECT_NEAR(furthest, 0.5, 1e-9);
      ++tight;
    }
  }
  EXPECT_GT(tight, 100);
}

TEST_P(MicroQuads, TheCenterIsThePointAndAPlaneSeenEdgeOnHasNothingElse) {
  Random random(33);
  for (int i = 0; i < 100; ++i) {
    const Case c(random, rays, steps, 0.0);
    EXPECT_EQ(c.quad.at(glm::dvec2(0.0)), c.point);
  }
  const glm::dvec3 point(0, 0, -4);
  for (const glm::dvec3& normal : {glm::dvec3(1, 0, 0), glm::dvec3(0, 0, 0)}) {
    const MicroQuad quad = micro_quad(point, tangent_slopes(point, normal, steps), steps);
    EXPECT_EQ(quad.shrink, 0.0);
    EXPECT_EQ(quad.at({0.5, -0.25}), point);
  }
}

INSTANTIATE_TEST_SUITE_P(Cameras, MicroQuads, testing::Bool(),
                         [](const auto& p) { return p.param ? "orthographic" : "perspective"; });

TEST(Samples, AWordHasABitASampleAndOneSampleFillsIt) {
  Receivers receivers;
  add_receiver(receivers, {1, 2, -3});
  EXPECT_EQ(receivers.point(0, 0), glm::dvec3(1, 2, -3));
  EXPECT_EQ(receivers.word_of(0), dark);
  EXPECT_EQ(receivers.bits_of(dark), 1u);
  EXPECT_EQ(receivers.bits_of(0xFFFFu), 1u);  // of a filter: half
  EXPECT_EQ(receivers.bits_of(0x7FFFu), 0u);
  EXPECT_EQ(receivers.bits_of(0u), 0u);
  Random random(34);
  receivers.offsets_px = random_offsets(random);
  EXPECT_EQ(receivers.word_of(31), 0x80000000u);
  EXPECT_EQ(receivers.bits_of(0x80000001u), 0x80000001u);
  EXPECT_NO_THROW(receivers.check("test"));
  receivers.slopes.resize(2);
  EXPECT_THROW(receivers.check("test"), Error);
  receivers.slopes.clear();
  receivers.offsets_px.pop_back();
  EXPECT_THROW(receivers.check("test"), Error);
}

}  // namespace
}  // namespace izb::reference
