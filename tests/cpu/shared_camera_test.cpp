// SPDX-License-Identifier: MIT
// Receiver points, normals and the light's window.
#include <gtest/gtest.h>

#include "shared/gbuffer.h"
#include "shared/lists.h"
#include "shared_fixture.h"

namespace izb::test {
namespace {

TEST(SharedCamera, ReceiverPointsLieOnTheirTrianglesPlaneToAFewUlps) {
  Random random(21);
  const shared::CameraFrame camera = perspective_camera();
  for (int i = 0; i < 100'000; ++i) {
    const double reach = std::pow(10.0, random.uniform(-2.0, 3.0));
    const glm::vec2 px(float(random.below(1920)) + 0.5f, float(random.below(1080)) + 0.5f);
    const glm::dvec3 center = glm::dvec3(shared::receiver_point(camera, px, float(reach)));
    const double size = reach * random.uniform(0.001, 0.9);
    const glm::vec3 a(center + random.point(size)), b(center + random.point(size)), c(center + random.point(size));
    const glm::dvec3 n = glm::cross(glm::dvec3(b) - glm::dvec3(a), glm::dvec3(c) - glm::dvec3(a));
    const shared::ReceiverPlane r = shared::intersect_plane(camera, px, a, b, c);
    EXPECT_NEAR(glm::length(r.normal_vs), 1.0f, 1e-6f);
    EXPECT_GT(r.eye_distance, 0.0f);
    const glm::dvec3 ray(px.x * double(camera.pixel_ray.x) + camera.pixel_ray.z,
                         px.y * double(camera.pixel_ray.y) + camera.pixel_ray.w, -1.0);
    EXPECT_LE(glm::dot(glm::dvec3(r.normal_vs), ray), 1e-6);  // towards the viewer
    const double t = glm::dot(n, glm::dvec3(a)) / glm::dot(n, ray);
    const double t_max = -std::min({a.z, b.z, c.z}), t_min = -std::max({a.z, b.z, c.z});
    if (t < t_min || t > t_max) continue;  // the ray misses the triangle by far
    const glm::vec3 p = shared::receiver_point(camera, px, r.eye_distance);
    const double distance = std::abs(glm::dot(n, glm::dvec3(p) - glm::dvec3(a))) / glm::length(n);
    EXPECT_LE(distance, 4.0 * shared::unit_roundoff * shared::norm1(p));
  }
}

TEST(SharedCamera, ASliverSeenEdgeOnStaysNearItsVertices) {
  const shared::CameraFrame camera = perspective_camera();
  // Its plane nearly holds the ray through the picture's centre: the true crossing is far away, or behind the eye.
  for (const float tilt : {1e-7f, -1e-7f, 0.0f}) {
    const shared::ReceiverPlane r = shared::intersect_plane(camera, {960.5f, 540.5f}, {0.0f, 0.0001f, -10.0f},
                                                            {0.001f, 0.0001f, -10.0f}, {0.0f, 0.0001f + tilt, -12.0f});
    EXPECT_GE(r.eye_distance, 8.0f - 0.001f);
    EXPECT_LE(r.eye_distance, 14.001f);
  }
}

TEST(SharedCamera, ATriangleThatFacesTheCameraExactlyIsNotSeenEdgeOn) {
  Random random(23);
  const shared::CameraFrame camera = perspective_camera();
  for (int i = 0; i < 10'000; ++i) {
    const double t = std::pow(10.0, random.uniform(-2.0, 5.0));
    const auto corner = [&] { return glm::vec3(glm::dvec2(random.point(t)), -t); };
    const glm::vec2 px(float(random.below(1920)) + 0.5f, float(random.below(1080)) + 0.5f);
    const shared::ReceiverPlane r = shared::intersect_plane(camera, px, corner(), corner(), corner());
    EXPECT_TRUE(r.on_plane) << i;
    EXPECT_EQ(r.eye_distance, float(t));
  }
}

TEST(SharedCamera, OctahedralNormalsSurviveARoundTrip) {
  Random random(22);
  for (int i = 0; i < 10'000; ++i) {
    const glm::vec3 n(random.direction());
    EXPECT_LT(glm::length(shared::octahedral_decode(shared::octahedral_encode(n)) - n), 1e-6f);
  }
  for (const glm::vec3 axis : {glm::vec3(1, 0, 0), glm::vec3(0, -1, 0), glm::vec3(0, 0, 1), glm::vec3(0, 0, -1)})
    EXPECT_EQ(shared::octahedral_decode(shared::octahedral_encode(axis)), axis);
}

TEST(SharedBounds, OrderedIntegersSortAsTheirFloats) {
  const float sorted[] = {-3.0e38f, -1.5f, -1e-30f, -0.0f, 0.0f, 1e-30f, 1.5f, 3.0e38f};
  for (size_t i = 0; i + 1 < std::size(sorted); ++i)
    EXPECT_LT(shared::ordered_from_float(sorted[i]), shared::ordered_from_float(sorted[i + 1]));
  for (const float f : sorted) EXPECT_EQ(shared::float_from_ordered(shared::ordered_from_float(f)), f);
}

TEST(SharedBounds, TheWindowHoldsItsReceiversAndNothingToSpare) {
  shared::ReceiverBounds bounds;
  const auto ordered = [](float x, float y, float z) {
    return glm::uvec4(shared::ordered_from_float(x), shared::ordered_from_float(y), shared::ordered_from_float(z), 0u);
  };
  bounds.low = ordered(-5.0f, 100.0f, 20.0f);
  bounds.high = ordered(7.0f, 101.0f, 30.0f);
  bounds.slack = glm::uvec4(shared::ordered_from_float(1e-6f), shared::ordered_from_float(1e-6f), 2u, 0u);
  const shared::LightFrame light = make_light({0, -1, 0}, nullptr, 1024);
  const shared::LightWindow w = shared::make_window(light, bounds);
  const glm::vec3 low = shared::grid_position(w, {-5.0f, 100.0f, 20.0f}),
                  high = shared::grid_position(w, {7.0f, 101.0f, 30.0f});
  EXPECT_NEAR(low.x, 1.0f, 0.01f);
  EXPECT_NEAR(low.y, 1.0f, 0.01f);
  EXPECT_NEAR(high.x, 1023.0f, 0.01f);
  EXPECT_NEAR(high.y, 1023.0f, 0.01f);
  EXPECT_NEAR(low.z, 0.25f, 1e-5f);
  EXPECT_NEAR(high.z, 0.75f, 1e-5f);
  bounds.slack.z = 0u;
  EXPECT_EQ(shared::make_window(light, bounds).guard.y, 0.0f);  // no receiver: the raster pass draws nothing
}

TEST(SharedBounds, AWindowWithoutExtentIsStillFinite) {
  shared::ReceiverBounds bounds;
  bounds.low = bounds.high = glm::uvec4(shared::ordered_from_float(3.0f));
  bounds.slack = glm::uvec4(shared::ordered_from_float(1e-6f), shared::ordered_from_float(1e-6f), 1u, 0u);
  const shared::LightWindow w = shared::make_window(make_light({0, -1, 0}, nullptr, 64), bounds);
  const glm::vec3 g = shared::grid_position(w, glm::vec3(3.0f));
  EXPECT_TRUE(std::isfinite(g.x) && std::isfinite(g.y) && std::isfinite(g.z) && std::isfinite(w.guard.x));
}

TEST(SharedLists, ANodesAddressIsItsPixelAndSlot) {
  const int last = shared::largest_picture_px - 1;
  for (const glm::ivec2 px : {glm::ivec2(0, 0), glm::ivec2(last, 0), glm::ivec2(0, last), glm::ivec2(last, last)})
    for (const int slot : {0, 3, 7}) {
      const uint32_t node = shared::node_from_pixel(px, slot);
      EXPECT_NE(node, shared::no_node);
      EXPECT_EQ(shared::pixel_from_node(node), px);
      EXPECT_EQ(shared::slot_from_node(node), slot);
    }
}

}  // namespace
}  // namespace izb::test
