// SPDX-License-Identifier: MIT
// The 32 shadow samples of a pixel as a whole frame has them, against the camera and a shadow in closed form.
#include "gl/frame_fixture.h"
#include "reference/points.h"

namespace izb::test {
namespace {

constexpr int width_px = 240, height_px = 180;

/// A floor, and a square of side 2 at height 2 over its middle.
Scene square_over_floor() {
  Scene scene = empty_scene();
  add_soup(scene, floor_of(12.0f));
  add_soup(scene, rectangle({-1, 2, -1}, {0, 0, 2}, {2, 0, 0}));
  return scene;
}

Camera camera_above(bool orthographic) {
  Camera camera = look_at({0.3, 9.0, 5.0}, {0, 0, 0}, glm::radians(45.0));
  camera.orthographic = orthographic;
  camera.ymag = 4.0;
  camera.far_plane = 40.0;
  return camera;
}

class Samples : public testing::TestWithParam<bool> {
 protected:
  void SetUp() override {
    if (!reference::embree_available()) GTEST_SKIP() << "built without Embree";
  }
};

TEST_P(Samples, LieOnTheFloorUnderTheirPlaceInThePixel) {
  const Camera camera = camera_above(GetParam());
  const Frame frame =
      render_frame(square_over_floor(), camera, sun(135, 50), width_px, height_px, {{"spp", "32"}}, "ray_traced");
  ASSERT_EQ(frame.receivers.sample_count(), 32);
  const reference::PixelRays rays = reference::pixel_rays(camera, width_px, height_px);
  size_t on_floor = 0;
  for (size_t i = 0; i < frame.mask.size(); ++i) {
    if (frame.receivers.own_triangle[i] > 1) continue;
    ++on_floor;
    for (int s = 0; s < 32; ++s) {
      // The camera's own ray through the sample's place, met with the floor in world space.
      const glm::vec2 offset = frame.inputs.samples.offsets_px[size_t(s)];
      const glm::dvec2 at(double(i % width_px) + offset.x, double(i / width_px) - offset.y);
      const glm::dvec3 o(camera.world_from_view * glm::dvec4(rays.origin_at(at.x, at.y), 1.0));
      const glm::dvec3 d(camera.world_from_view * glm::dvec4(rays.direction_at(at.x, at.y), 0.0));
      const glm::dvec3 sample(camera.world_from_view * glm::dvec4(frame.receivers.point(i, s), 1.0));
      EXPECT_LE(glm::length(sample - (o - d * (o.y / d.y))), 1e-5) << i;
    }
  }
  EXPECT_GT(on_floor, 5000u);
}

TEST_P(Samples, HaveTheSquaresShadow) {
  const Camera camera = camera_above(GetParam());
  const Light light = sun(135, 50);
  const Frame frame =
      render_frame(square_over_floor(), camera, light, width_px, height_px, {{"spp", "32"}}, "ray_traced");
  size_t wrong = 0, inside = 0, mixed = 0;
  for (size_t i = 0; i < frame.mask.size(); ++i) {
    if (frame.receivers.own_triangle[i] > 1) continue;
    mixed += frame.mask[i] != 0 && frame.mask[i] != 0xffffffffu;
    for (int s = 0; s < 32; ++s) {
      const glm::dvec3 p(camera.world_from_view * glm::dvec4(frame.receivers.point(i, s), 1.0));
      const glm::dvec3 on = p + light.direction_ws * ((2.0 - p.y) / light.direction_ws.y);
      const double reach = std::max(std::abs(on.x), std::abs(on.z)) - 1.0;
      if (std::abs(reach) < 1e-5) continue;
      inside += reach < 0.0;
      wrong += (frame.mask[i] >> s & 1u) != (reach < 0.0);
    }
  }
  EXPECT_EQ(wrong, 0u);
  EXPECT_GT(inside, 32u * 300u);
  EXPECT_GT(mixed, 50u);
  EXPECT_EQ(frame.count("rays"), 32u * receivers(frame));
}

TEST_P(Samples, OneSampleIsThePointAndFillsTheWord) {
  const Frame frame = render_frame(square_over_floor(), camera_above(GetParam()), sun(135, 50), width_px, height_px,
                                   {{"spp", "1"}}, "ray_traced");
  EXPECT_EQ(frame.receivers.sample_count(), 1);
  EXPECT_GT(shadowed(frame), 300u);
  for (size_t i = 0; i < frame.mask.size(); ++i) {
    EXPECT_TRUE(frame.mask[i] == 0 || frame.mask[i] == 0xffffffffu);
    EXPECT_EQ(frame.receivers.point(i, 0), glm::dvec3(frame.receivers.points_vs[i]));
  }
  EXPECT_EQ(frame.count("rays"), receivers(frame));
}

INSTANTIATE_TEST_SUITE_P(Cameras, Samples, testing::Bool(),
                         [](const auto& p) { return p.param ? "orthographic" : "perspective"; });

}  // namespace
}  // namespace izb::test
