// SPDX-License-Identifier: MIT
#include "reference/points.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "base/error.h"
#include "reference/exact.h"
#include "reference_fixture.h"

namespace izb::reference {
namespace {

constexpr int width_px = 64, height_px = 48;

// What a faultless G-buffer holds: the nearest triangle at each pixel's centre and the point on it.
Receivers render(const Triangles& triangles, const PixelRays& rays) {
  Receivers receivers;
  for (int y = 0; y < rays.height_px; ++y)
    for (int x = 0; x < rays.width_px; ++x) {
      const glm::dvec3 o = rays.origin_at(x, y), d = rays.direction_at(x, y);
      double nearest = rays.t_far;
      uint32_t own = no_own_triangle;
      for (uint32_t t = 0; t < triangles.count(); ++t) {
        const Corners c = corners(triangles, t);
        const glm::dvec3 a = glm::dvec3(c.a) - o, b = glm::dvec3(c.b) - o, e = glm::dvec3(c.c) - o;
        const double ab = glm::dot(glm::cross(a, b), d), be = glm::dot(glm::cross(b, e), d),
                     ea = glm::dot(glm::cross(e, a), d);
        if (!((ab >= 0 && be >= 0 && ea >= 0) || (ab <= 0 && be <= 0 && ea <= 0))) continue;
        const glm::dvec3 n = glm::cross(b - a, e - a);
        const double depth = glm::dot(n, a) / glm::dot(n, d);
        if (depth >= rays.t_near && depth < nearest) nearest = depth, own = t;
      }
      add_receiver(receivers, own == no_own_triangle ? glm::dvec3(0) : o + nearest * d, 1e-3f, own);
      if (own == no_own_triangle) receivers.classes.back() = PixelClass::sky;
    }
  return receivers;
}

// A ramp that passes under the camera, a wall, and a cloud of triangles, in view space.
Triangles room() {
  Triangles triangles;
  Random random(2);
  const glm::vec3 left{-50, 4, -90}, right{50, 4, -90}, near_left{-50, -2.5f, 10}, near_right{50, -2.5f, 10};
  add_triangle(triangles, left, right, near_right);
  add_triangle(triangles, left, near_right, near_left);
  add_triangle(triangles, {-30, -2, -60}, {5, -2, -60}, {-10, 25, -62});
  for (int i = 0; i < 300; ++i) {
    const glm::vec3 at = random.point(-1.0, 1.0) * glm::vec3(8, 4, 10) + glm::vec3(0, 2, -14);
    add_triangle(triangles, at, at + random.point(-1.0, 1.0), at + random.point(-1.0, 1.0));
  }
  return triangles;
}

class ReferencePoints : public testing::TestWithParam<bool> {
 protected:
  void SetUp() override {
    if (!embree_available()) GTEST_SKIP() << "built without Embree";
    Camera camera;
    camera.orthographic = GetParam();
    camera.ymag = 5.0;
    camera.near_plane = 0.1;
    camera.far_plane = 200.0;
    rays = pixel_rays(camera, width_px, height_px);
    triangles = room();
    tracer.emplace(triangles);
    receivers = render(triangles, rays);
  }
  PointCheck check() const { return check_points(*tracer, triangles, rays, receivers); }
  uint32_t pixel(int x, int y) const { return static_cast<uint32_t>(y * width_px + x); }

  PixelRays rays;
  Triangles triangles;
  std::optional<RayTracer> tracer;
  Receivers receivers;
};

TEST_P(ReferencePoints, FaultlessOnesPass) {
  const PointCheck found = check();
  EXPECT_EQ(found.checked, static_cast<uint64_t>(width_px * height_px));
  EXPECT_EQ(found.ok, found.checked);
  EXPECT_LE(found.max_plane_ulps, 1.0);
  EXPECT_LE(found.max_ray_offset_px, 1e-3);
  size_t sky = 0, on_cloud = 0;
  for (size_t i = 0; i < receivers.classes.size(); ++i) {
    sky += receivers.classes[i] == PixelClass::sky;
    on_cloud += receivers.own_triangle[i] >= 3 && receivers.own_triangle[i] != no_own_triangle;
  }
  EXPECT_GT(sky, 50u);
  EXPECT_GT(on_cloud, 200u);
}

TEST_P(ReferencePoints, RaysMeetTheImageBorder) {
  // The corner of the image is half a pixel from the first pixel's centre.
  const double half_height = GetParam() ? 5.0 : std::tan(0.4);
  const glm::dvec3 corner = rays.origin_at(-0.5, -0.5) + rays.direction_at(-0.5, -0.5);
  EXPECT_NEAR(corner.x, -half_height * width_px / height_px, 1e-12);
  EXPECT_NEAR(corner.y, half_height, 1e-12);
  const glm::dvec3 end =
      rays.origin_at(width_px - 0.5, height_px - 0.5) + rays.direction_at(width_px - 0.5, height_px - 0.5);
  EXPECT_NEAR(end.x, half_height * width_px / height_px, 1e-12);
  EXPECT_NEAR(end.y, -half_height, 1e-12);
}

TEST_P(ReferencePoints, AWrongTriangleIsSeen) {
  size_t planted = 0;
  for (uint32_t i = 0; i < receivers.classes.size(); i += 100, ++planted) {
    // The floor where something else is, something else where the floor is, nothing or something in the sky.
    if (receivers.classes[i] == PixelClass::sky) {
      receivers.classes[i] = PixelClass::receiver;
      receivers.own_triangle[i] = 2;
    } else if (i % 3 == 0) {
      receivers.classes[i] = PixelClass::sky;
    } else {
      receivers.own_triangle[i] = receivers.own_triangle[i] == 7 ? 8 : 7;
    }
  }
  const PointCheck found = check();
  EXPECT_GE(found.wrong + found.near_edge, planted);
  EXPECT_LE(found.near_edge, planted / 5);
  EXPECT_EQ(found.ok, found.checked - found.wrong - found.near_edge);
  EXPECT_EQ(found.wrong_pixels.size(), std::min<size_t>(found.wrong, 100));
}

TEST_P(ReferencePoints, AHiddenTriangleIsSeen) {
  // The triangle behind, where the front one covers the pixel by more than the tolerance.
  Triangles two;
  add_triangle(two, {-9, -9, -5}, {9, -9, -5}, {0.3f, 20, -5});
  add_triangle(two, {-30, -30, -8}, {30, -30, -8}, {0, 60, -8});
  const RayTracer over_two(two);
  receivers = render(two, rays);
  EXPECT_EQ(check_points(over_two, two, rays, receivers).ok, static_cast<uint64_t>(width_px * height_px));
  const uint32_t middle = pixel(width_px / 2, height_px / 2);
  ASSERT_EQ(receivers.own_triangle[middle], 0u);
  receivers.own_triangle[middle] = 1;
  const PointCheck found = check_points(over_two, two, rays, receivers);
  EXPECT_EQ(found.wrong, 1u);
  EXPECT_EQ(found.wrong_pixels, std::vector<uint32_t>{middle});
}

TEST_P(ReferencePoints, AHiddenTrianglesOwnEdgeExcusesNothing) {
  // The hidden one has an edge 0.003 pixels from the centres of a column.
  const auto behind = [&](double y) { return rays.origin_at(20.003, y) + 8.0 * rays.direction_at(20.003, y); };
  Triangles two;
  add_triangle(two, {-90, -90, -5}, {90, -90, -5}, {0, 200, -5});
  add_triangle(two, behind(-9), behind(99), behind(99) - glm::dvec3(60, 0, 0));
  const RayTracer over_two(two);
  receivers = render(two, rays);
  receivers.own_triangle[pixel(20, 24)] = 1;
  const PointCheck found = check_points(over_two, two, rays, receivers);
  EXPECT_EQ(found.near_edge, 0u);
  EXPECT_EQ(found.wrong_pixels, std::vector<uint32_t>{pixel(20, 24)});
}

TEST_P(ReferencePoints, ATriangleThatTheFloatRaysPreferWronglyIsSeen) {
  // Two parallel floors, tilted, and so large that float rays may take the lower for the nearer.
  Random random(3);
  std::vector<uint32_t> planted;
  for (int trial = 0; trial < 50 && planted.empty(); ++trial) {
    Triangles floors;
    for (const double height : {-10.0, -10.01}) {
      const auto corner = [&](double x, double z) {
        const glm::dvec2 at = 1e5 * (glm::dvec2(x, z) + 0.2 * glm::dvec2(random.point(-1.0, 1.0)));
        return glm::vec3(at.x, height + 0.237 * at.x - 0.319 * at.y, at.y);
      };
      add_triangle(floors, corner(-1.3, -1.1), corner(1.7, -1.2), corner(0.1, 1.9));
    }
    const RayTracer over_floors(floors);
    receivers = render(floors, rays);
    EXPECT_EQ(check_points(over_floors, floors, rays, receivers).wrong, 0u);
    for (int y = 1; y < height_px; y += 2)
      for (int x = 1; x < width_px; x += 2) {
        const std::vector<glm::vec3> origin{rays.origin_at(x, y)}, direction{rays.direction_at(x, y)};
        if (receivers.own_triangle[pixel(x, y)] != 0u) continue;
        if (over_floors.primary_hits(origin, direction, 0.1f, 200.0f).triangle[0] != 1u) continue;
        receivers.own_triangle[pixel(x, y)] = 1;
        planted.push_back(pixel(x, y));
      }
    planted.resize(std::min<size_t>(planted.size(), 100));
    EXPECT_EQ(check_points(over_floors, floors, rays, receivers).wrong_pixels, planted);
  }
  EXPECT_FALSE(planted.empty());
}

TEST_P(ReferencePoints, ATriangleBeyondTheCamerasPlanesIsSeen) {
  // All three fill the view: before the near plane, behind the camera, beyond the far plane.
  for (const float z : {-0.05f, 3.0f, -300.0f}) {
    Triangles one;
    add_triangle(one, {-900, -900, z}, {900, -900, z}, {0, 1800, z});
    receivers = render(one, rays);
    EXPECT_EQ(check_points(RayTracer(one), one, rays, receivers).ok, receivers.count()) << z;
    receivers.classes[pixel(20, 24)] = PixelClass::receiver;
    receivers.own_triangle[pixel(20, 24)] = 0;
    EXPECT_EQ(check_points(RayTracer(one), one, rays, receivers).wrong_pixels, std::vector<uint32_t>{pixel(20, 24)})
        << z;
  }
}

TEST_P(ReferencePoints, AMovedPointIsMeasured) {
  uint32_t floor_pixel = 0;
  for (uint32_t i = 0; i < receivers.classes.size(); ++i)
    if (receivers.own_triangle[i] < 2) floor_pixel = i;
  receivers.points_vs[floor_pixel].y += 100.0f * 7.62939453125e-06f;  // 100 ulps of 90
  PointCheck found = check();
  EXPECT_NEAR(found.max_plane_ulps, 100.0, 2.0);
  EXPECT_EQ(found.max_plane_pixel, floor_pixel);
  receivers.points_vs[floor_pixel] +=
      2.0 * (rays.direction_dx * double{-receivers.points_vs[floor_pixel].z} + rays.origin_dx);
  found = check();
  EXPECT_NEAR(found.max_ray_offset_px, 2.0, 0.1);
  EXPECT_EQ(found.max_ray_offset_pixel, floor_pixel);
}

TEST_P(ReferencePoints, ALiftedMicroQuadIsMeasured) {
  uint32_t floor_pixel = 0;
  for (uint32_t i = 0; i < receivers.classes.size(); ++i)
    if (receivers.own_triangle[i] < 2) floor_pixel = i;
  receivers.centers_vs = receivers.points_vs;
  receivers.camera = {glm::dvec2(GetParam() ? rays.origin_dx.x : rays.direction_dx.x), !GetParam()};
  EXPECT_EQ(check().lifted, 0u);
  const glm::vec3 point = receivers.points_vs[floor_pixel];
  glm::vec3& center = receivers.centers_vs[floor_pixel];
  const Corners own = corners(triangles, receivers.own_triangle[floor_pixel]);
  const glm::dvec3 across = glm::normalize(normal(own));
  for (const float way : {0.01f, -0.01f}) {
    center = GetParam() ? point + glm::vec3(0, 0, way) : point * (1.0f - way);
    const PointCheck found = check();
    EXPECT_EQ(found.lifted, 1u);
    EXPECT_EQ(found.max_lift_pixel, floor_pixel);
    EXPECT_LE(found.max_ray_offset_px, 1e-3);
    EXPECT_LE(found.max_plane_ulps, 1.0) << "the point is where it was";
    const double step = receivers.camera.step.x * (GetParam() ? 1.0 : -double(point.z));
    const double lift_px = std::abs(glm::dot(across, glm::dvec3(center) - glm::dvec3(point))) / step;
    if (way > 0.0f)
      EXPECT_NEAR(found.max_lift_px, lift_px, 1e-9);
    else
      EXPECT_TRUE(std::isinf(found.max_lift_px)) << "below its plane";
  }
}

TEST_P(ReferencePoints, ATriangleMovedByLessThanTheToleranceIsNearAnEdge) {
  // Two triangles share an edge that passes 0.003 pixels (or 0.05) from the centres of a column.
  for (const double distance_px : {0.003, -0.003, 0.05}) {
    const double column = 20.0 + distance_px, depth = 10.0;
    const glm::dvec3 top = rays.origin_at(column, -9) + depth * rays.direction_at(column, -9);
    const glm::dvec3 bottom = rays.origin_at(column, 99) + depth * rays.direction_at(column, 99);
    Triangles pair;
    add_triangle(pair, top, bottom, bottom - glm::dvec3(60, 0, 0));
    add_triangle(pair, top, bottom, bottom + glm::dvec3(60, 0, 0));
    const RayTracer over_pair(pair);
    receivers = render(pair, rays);
    EXPECT_EQ(check_points(over_pair, pair, rays, receivers).wrong, 0u);
    for (int y = 0; y < height_px; ++y) receivers.own_triangle[pixel(20, y)] = distance_px > 0.0 ? 1 : 0;
    const PointCheck found = check_points(over_pair, pair, rays, receivers);
    EXPECT_EQ(found.near_edge, distance_px == 0.05 ? 0u : static_cast<uint64_t>(height_px)) << distance_px;
    EXPECT_EQ(found.wrong, distance_px == 0.05 ? static_cast<uint64_t>(height_px) : 0u) << distance_px;
  }
}

TEST_P(ReferencePoints, DuplicatesAndCrossingsAreTies) {
  // A wall, a copy of it that is tilted by a few ulps, one clearly behind.
  Triangles walls;
  add_triangle(walls, {-90, -90, -10}, {90, -90, -10}, {0, 180, -10});
  add_triangle(walls, {-90, -90, -10.000004f}, {90, -90, -10}, {0, 180, -10});
  add_triangle(walls, {-90, -90, -10.01f}, {90, -90, -10.01f}, {0, 180, -10.01f});
  const RayTracer over_walls(walls);
  receivers = render(walls, rays);
  for (uint32_t& own : receivers.own_triangle) own = own == 0 ? 1 : 0;
  PointCheck found = check_points(over_walls, walls, rays, receivers);
  EXPECT_EQ(found.wrong, 0u);
  EXPECT_EQ(found.near_edge, 0u);
  EXPECT_GT(found.depth_tie, 0u);
  for (uint32_t& own : receivers.own_triangle) own = 2;
  found = check_points(over_walls, walls, rays, receivers);
  EXPECT_EQ(found.wrong, found.checked);
}

TEST_P(ReferencePoints, RefusesReceiversThatAreNotOneAPixel) {
  receivers.points_vs.pop_back();
  EXPECT_THROW(check(), Error);
}

INSTANTIATE_TEST_SUITE_P(Cameras, ReferencePoints, testing::Bool(),
                         [](const auto& p) { return p.param ? "orthographic" : "perspective"; });

}  // namespace
}  // namespace izb::reference
