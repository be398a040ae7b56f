// SPDX-License-Identifier: MIT
#include "reference/model.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "reference/exact.h"
#include "reference_fixture.h"

namespace izb::reference {
namespace {

constexpr int size_px = 32;

// A wall that an orthographic camera sees face on, a blade before its left half, light from the camera's side.
class Model : public testing::Test {
 protected:
  void SetUp() override {
    if (!embree_available()) GTEST_SKIP() << "built without Embree";
    Camera camera;
    camera.orthographic = true;
    camera.ymag = 1.0;
    rays = pixel_rays(camera, size_px, size_px);
    add_triangle(triangles, {-9, -9, -5}, {9, -9, -5}, {0, 30, -5});
    Random random(3);
    receivers.offsets_px = random_offsets(random);
    receivers.camera = {{rays.origin_dx.x, -rays.origin_dy.y}, false};
    for (int y = 0; y < size_px; ++y)
      for (int x = 0; x < size_px; ++x) {
        add_receiver(receivers, glm::vec3(rays.origin_at(x, y)) + glm::vec3(0, 0, -5), 1e-3f, 0);
        receivers.slopes.emplace_back(0.0);
      }
  }
  ModelError compare() const {
    const RayTracer tracer(triangles);
    return compare_model(tracer, triangles, light, rays, receivers, tracer.trace_mask(light, receivers).mask);
  }

  const LightPoint light{{0.5f, 0.25f, 1.0f}, false};
  PixelRays rays;
  Triangles triangles;
  Receivers receivers;
};

TEST_F(Model, HasNoErrorOnAPlane) {
  // The caster is out of sight, its shadow on the wall is not.
  add_triangle(triangles, {1.3f, -9, -2}, {9, -9, -2}, {1.3f, 30, -2});
  const ModelError error = compare();
  EXPECT_EQ(error.compared, 32u * size_px * size_px);
  EXPECT_EQ(error.differing, 0u);
  EXPECT_EQ(error.percent(), 0.0);
}

TEST_F(Model, CountsSamplesThatSeeSomethingElse) {
  // A blade covers the wall from the middle of a column's pixels on: their centres see the wall, a part of the samples
  // the blade. Its shadow covers the wall beside it, the blade itself is lit.
  const float left = static_cast<float>(rays.origin_at(15.25, 0).x);
  add_triangle(triangles, {left, -9, -4}, {9, -9, -4}, {left, 40, -4});
  for (int y = 0; y < size_px; ++y)
    for (int x = 16; x < size_px; ++x) receivers.classes[static_cast<size_t>(y * size_px + x)] = PixelClass::culled;
  uint64_t on_blade = 0;
  for (const glm::dvec2& offset : receivers.offsets_px) on_blade += offset.x > 0.25;
  ASSERT_GT(on_blade, 3u);
  const ModelError error = compare();
  EXPECT_EQ(error.compared, 32u * 16 * size_px);
  EXPECT_EQ(error.differing, on_blade * size_px);
}

TEST_F(Model, OffsetsPointUpwards) {
  // The same, with a blade that covers the upper part of a row's pixels.
  const float bottom = static_cast<float>(rays.origin_at(0, 15.75).y);
  add_triangle(triangles, {-99, bottom, -4}, {99, bottom, -4}, {0, 99, -4});
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < size_px; ++x) receivers.classes[static_cast<size_t>(y * size_px + x)] = PixelClass::culled;
  receivers.offsets_px.assign(32, glm::dvec2(0.0, 0.4));
  EXPECT_EQ(compare().differing, 32u * size_px);
  receivers.offsets_px.assign(32, glm::dvec2(0.0, -0.4));
  EXPECT_EQ(compare().differing, 0u);
}

TEST_F(Model, LeavesOutSamplesThatSeeTheSky) {
  triangles = {};
  const float left = static_cast<float>(rays.origin_at(15.25, 0).x);
  add_triangle(triangles, {left, -9, -5}, {left, 30, -5}, {-40, -9, -5});
  uint64_t off_wall = 0;
  for (const glm::dvec2& offset : receivers.offsets_px) off_wall += offset.x > 0.25;
  for (int y = 0; y < size_px; ++y)
    for (int x = 16; x < size_px; ++x) receivers.classes[static_cast<size_t>(y * size_px + x)] = PixelClass::sky;
  EXPECT_EQ(compare().compared, (32u * 16 - off_wall) * size_px);
}

TEST_F(Model, RefusesMasksOfAnotherSize) {
  const RayTracer tracer(triangles);
  EXPECT_THROW(compare_model(tracer, triangles, light, rays, receivers, std::vector<uint32_t>(3)), Error);
}

}  // namespace
}  // namespace izb::reference
