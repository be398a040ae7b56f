// SPDX-License-Identifier: MIT
#include "reference/embree.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "base/error.h"
#include "reference/exact.h"
#include "reference/settle.h"
#include "reference_fixture.h"

namespace izb::reference {
namespace {

class ReferenceEmbree : public testing::Test {
 protected:
  void SetUp() override {
    if (!embree_available()) GTEST_SKIP() << "built without Embree";
  }
};

// 800 random triangles over a floor of two (triangles 0 and 1), receivers on the floor and on the triangles.
struct Frame {
  Triangles triangles;
  Receivers receivers;

  Frame() {
    Random random(11);
    add_rectangle(triangles, -6.0f, 6.0f, -6.0f, 6.0f, 0.0f);
    for (int i = 0; i < 800; ++i) {
      const glm::vec3 at = random.point(-4.0, 4.0) * glm::vec3(1.0f, 0.4f, 1.0f) + glm::vec3(0.0f, 2.0f, 0.0f);
      add_triangle(triangles, at, at + random.point(-0.5, 0.5), at + random.point(-0.5, 0.5));
    }
    for (int y = 0; y < 90; ++y)
      for (int x = 0; x < 101; ++x) {
        const double px = random.uniform(-5.0, 5.0), pz = random.uniform(-5.0, 5.0);
        add_receiver(receivers, glm::vec3(px, 0.0, pz), 1e-4f, px > pz ? 0u : 1u);
      }
    for (uint32_t t = 2; t < triangles.count(); ++t)
      for (int k = 0; k < 6; ++k) {
        const double u = random.uniform(0.0, 1.0), v = random.uniform(0.0, 1.0 - u);
        const Corners c = corners(triangles, t);
        const glm::dvec3 a(c.a);
        add_receiver(receivers, a + u * (glm::dvec3(c.b) - a) + v * (glm::dvec3(c.c) - a), 1e-4f, t);
      }
    for (size_t i = 0; i < receivers.classes.size(); i += 7) receivers.classes[i] = PixelClass::culled;
  }
};

const LightPoint lights[] = {
    {{0.3f, 1.0f, 0.2f}, false}, {{3e4f, 1e4f, 2e4f}, false}, {{0.5f, 2.0f, -0.3f}, true}, {{5.0f, 30.0f, 9.0f}, true}};

TEST_F(ReferenceEmbree, MaskIsTheExactMaskExceptWhereFloatRaysErr) {
  const Frame frame;
  RayTracer tracer(frame.triangles);
  for (const LightPoint& light : lights) {
    const std::vector<uint32_t> exact = exact_mask(frame.triangles, light, frame.receivers);
    size_t dark_count = 0;
    for (const uint32_t word : exact) dark_count += word == dark;
    EXPECT_GT(dark_count, exact.size() / 20);
    const MaskTrace rays = tracer.trace_mask(light, frame.receivers);
    const Settled settled = settle(frame.triangles, light, frame.receivers, exact, rays.mask);
    EXPECT_EQ(settled.compared, rays.rays);
    EXPECT_LE(settled.disputed, 10u);
    EXPECT_EQ(settled.settled_ours, settled.disputed);
    // The other way round, the rays' errors are rounding: each lies at an edge or at a plane.
    const Settled judged = settle(frame.triangles, light, frame.receivers, rays.mask, exact);
    EXPECT_EQ(judged.settled_ours, 0u);
    EXPECT_EQ(judged.explained, judged.disputed);
  }
}

// The same with 32 samples a receiver, on planes of random tilt, in front of an orthographic camera.
Frame with_samples(Frame frame) {
  Random random(12);
  Receivers& r = frame.receivers;
  r.offsets_px = random_offsets(random);
  r.camera = {{0.03, 0.02}, false};
  for (size_t i = 0; i < r.count(); ++i) r.slopes.emplace_back(random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1));
  for (glm::vec3& p : r.points_vs) p.z -= 20.0f;
  for (glm::vec3& v : frame.triangles.positions_vs) v.z -= 20.0f;
  return frame;
}

TEST_F(ReferenceEmbree, EachOf32BitsIsTheExactOneExceptWhereFloatRaysErr) {
  Frame frame = with_samples({});
  // All pairs of samples and triangles take a while: every tenth receiver.
  for (size_t i = 0; i < frame.receivers.count(); ++i)
    if (i % 10 != 1) frame.receivers.classes[i] = PixelClass::culled;
  const RayTracer tracer(frame.triangles);
  for (LightPoint light : lights) {
    if (light.positional) light.xyz_vs.z -= 20.0f;
    const std::vector<uint32_t> exact = exact_mask(frame.triangles, light, frame.receivers);
    size_t mixed = 0;
    for (const uint32_t word : exact) mixed += word != 0 && word != dark;
    EXPECT_GT(mixed, 20u);
    const MaskTrace rays = tracer.trace_mask(light, frame.receivers);
    const Settled settled = settle(frame.triangles, light, frame.receivers, exact, rays.mask);
    EXPECT_EQ(settled.compared, rays.rays);
    EXPECT_LE(settled.disputed, settled.compared / 1000);
    EXPECT_EQ(settled.settled_ours, settled.disputed);
    const Settled judged = settle(frame.triangles, light, frame.receivers, rays.mask, exact);
    EXPECT_EQ(judged.explained, judged.disputed);
  }
}

TEST_F(ReferenceEmbree, EveryBuildThreadCountAndPacketShapeGivesTheSameMask) {
  for (const Frame& frame : {Frame(), with_samples({})})
    for (const LightPoint& light : lights) {
      RayTracer tracer(frame.triangles, BuildQuality::medium, 1);
      const std::vector<uint32_t> mask = tracer.trace_mask(light, frame.receivers).mask;
      for (const BuildQuality quality : {BuildQuality::low, BuildQuality::high}) {
        EXPECT_GT(tracer.rebuild(quality), 0.0);
        EXPECT_EQ(tracer.trace_mask(light, frame.receivers).mask, mask);
      }
      RayTracer moved = std::move(tracer);
      EXPECT_EQ(moved.trace_mask(light, frame.receivers).mask, mask);
      Receivers image = frame.receivers;
      image.width_px = 101;
      while (image.points_vs.size() % 101 != 0) {
        add_receiver(image, {0, 0, 0});
        image.classes.back() = PixelClass::sky;
        if (!image.slopes.empty()) image.slopes.emplace_back(0.0);
      }
      std::vector<uint32_t> tiled = RayTracer(frame.triangles, BuildQuality::low, 3).trace_mask(light, image).mask;
      tiled.resize(mask.size());
      EXPECT_EQ(tiled, mask);
    }
}

TEST_F(ReferenceEmbree, OwnTriangleIsSkippedAtGrazingLight) {
  // Points rounded to either side of a tilted triangle, the light almost in its plane.
  Random random(5);
  Triangles triangles;
  const glm::vec3 a{-40.3f, 1.7f, -39.1f}, b{41.9f, 3.3f, -37.7f}, c{0.7f, 9.1f, 43.3f};
  add_triangle(triangles, a, b, c);
  Receivers receivers;
  for (int i = 0; i < 1000; ++i) {
    const float u = static_cast<float>(random.uniform(0.0, 0.5)), v = static_cast<float>(random.uniform(0.0, 0.5));
    add_receiver(receivers, a + u * (b - a) + v * (c - a), 1e-3f, 0);
  }
  const glm::vec3 normal = glm::normalize(glm::cross(c - a, b - a));
  const LightPoint grazing{glm::normalize(b - a) + 1e-5f * normal, false};
  RayTracer tracer(triangles);
  for (const uint32_t word : tracer.trace_mask(grazing, receivers).mask) EXPECT_EQ(word, 0u);
  // Without the name of its own triangle such a point is in the dark, or this test tests nothing.
  for (uint32_t& own : receivers.own_triangle) own = no_own_triangle;
  size_t occluded = 0;
  for (const uint32_t word : tracer.trace_mask(grazing, receivers).mask) occluded += word == dark;
  EXPECT_GT(occluded, 50u);
}

TEST_F(ReferenceEmbree, LampIsNotOccludedFromBehind) {
  Triangles triangles;
  add_rectangle(triangles, -9.0f, 9.0f, -9.0f, 9.0f, 5.0f);   // behind the lamp
  add_rectangle(triangles, -9.0f, 9.0f, -9.0f, 9.0f, -1.0f);  // behind the receiver
  Receivers receivers;
  add_receiver(receivers, {0.2f, 0.0f, 0.1f});
  RayTracer tracer(triangles);
  EXPECT_EQ(tracer.trace_mask({{0, 4, 0}, true}, receivers).mask[0], 0u);
  EXPECT_EQ(tracer.trace_mask({{0, 6, 0}, true}, receivers).mask[0], dark);
  EXPECT_EQ(tracer.trace_mask({{0, 1, 0}, false}, receivers).mask[0], dark);
}

TEST_F(ReferenceEmbree, CameraRaysFindTheNearestAndAllHits) {
  Triangles triangles;
  add_rectangle(triangles, -1.0f, 1.0f, -1.0f, 1.0f, 2.0f);
  add_rectangle(triangles, -1.0f, 1.0f, -1.0f, 1.0f, 3.0f);
  const RayTracer tracer(triangles);
  std::vector<glm::vec3> directions(40, glm::vec3(0.1f, 2.0f, 0.05f));
  directions[37] = {9.0f, 1.0f, 0.0f};
  const glm::vec3 origin(0.0f);
  PrimaryHits hits = tracer.primary_hits({&origin, 1}, directions);
  for (size_t i = 0; i < directions.size(); ++i) {
    EXPECT_EQ(hits.triangle[i], i == 37 ? no_triangle : 0u);
    if (i != 37) {
      EXPECT_FLOAT_EQ(hits.t[i], 1.0f);
    }
  }
  hits = tracer.primary_hits({&origin, 1}, directions, 1.2f);
  EXPECT_EQ(hits.triangle[0], 2u);
  EXPECT_FLOAT_EQ(hits.t[0], 1.5f);
  EXPECT_EQ(tracer.primary_hits({&origin, 1}, directions, 0.0f, 0.9f).triangle[0], no_triangle);
  std::vector<float> ends(directions.size(), std::numeric_limits<float>::infinity());
  ends[20] = 1.2f, ends[39] = 0.5f;
  const std::vector<glm::vec3> origins(directions.size(), origin);
  const AllHits all = tracer.all_hits(origins, directions, 0.0f, ends);
  for (size_t i = 0; i < directions.size(); ++i) {
    std::vector<uint32_t> expected{0, 2};
    if (i == 20) expected = {0};
    if (i == 37 || i == 39) expected.clear();
    EXPECT_TRUE(std::ranges::equal(all.of(i), expected)) << i;
  }
}

TEST_F(ReferenceEmbree, RefusesWhatCannotBeTraced) {
  EXPECT_THROW(RayTracer(Triangles{}), Error);
  Triangles triangles;
  add_rectangle(triangles, -1.0f, 1.0f, -1.0f, 1.0f, 2.0f);
  const RayTracer tracer(triangles);
  Receivers receivers;
  add_receiver(receivers, {0, 0, 0});
  receivers.width_px = 2;
  EXPECT_THROW(tracer.trace_mask(lights[0], receivers), Error);
  receivers.width_px = 0;
  receivers.classes.clear();
  EXPECT_THROW(tracer.trace_mask(lights[0], receivers), Error);
  EXPECT_THROW(tracer.primary_hits(std::vector<glm::vec3>(2), std::vector<glm::vec3>(3)), Error);
  EXPECT_THROW(tracer.all_hits(std::vector<glm::vec3>(3), std::vector<glm::vec3>(3), 0.0f, std::vector<float>(2)),
               Error);
}

TEST(ReferenceEmbreeAbsent, IsANamedRefusal) {
  if (embree_available()) GTEST_SKIP() << "built with " << embree_version();
  EXPECT_THROW(RayTracer(Triangles{}), Error);
}

}  // namespace
}  // namespace izb::reference
