// SPDX-License-Identifier: MIT
// Lifted micro-quads over surfaces of two planes, whose shape is known in double.
#include <gtest/gtest.h>

#include <array>

#include "shared/insertion.h"
#include "shared/lift.h"
#include "shared_fixture.h"

namespace izb::test {
namespace {

shared::CameraFrame orthographic_camera() {
  shared::CameraFrame camera = perspective_camera();
  const double step = 0.01;
  camera.pixel_ray = glm::vec4(step, step, -0.5 * step * camera.size_px.x, -0.5 * step * camera.size_px.y);
  camera.footprint = glm::vec4(0.0f, step, 0.0f, 0.0f);
  return camera;
}

struct Plane {
  glm::dvec3 point, normal;  // towards the viewer
  double height(const glm::dvec3& p) const { return glm::dot(normal, p - point); }
};

enum class Shape { valley, ridge };

/// Two planes, of which a ray meets the nearer (a valley) or the further one (a ridge).
struct Surface {
  shared::CameraFrame camera;
  std::array<Plane, 2> planes;
  Shape shape = Shape::valley;

  struct Seen {
    double t = 0.0;
    int plane = 0;
  };
  Seen seen(const glm::dvec2& px) const {
    const glm::dvec3 zero(shared::receiver_point(camera, glm::vec2(px), 0.0f));
    const glm::dvec3 one(shared::receiver_point(camera, glm::vec2(px), 1.0f));
    const auto t = [&](const Plane& p) { return p.height(zero) / glm::dot(p.normal, zero - one); };
    const std::array<double, 2> both{t(planes[0]), t(planes[1])};
    const int plane = (both[0] < both[1]) == (shape == Shape::valley) ? 0 : 1;
    return {both[size_t(plane)], plane};
  }
};

/// As the pass finds it.
float highest_rise(const Surface& s, const glm::ivec2& px) {
  const Surface::Seen own = s.seen(glm::dvec2(px) + 0.5);
  const glm::vec3 p = shared::receiver_point(s.camera, glm::vec2(px) + 0.5f, float(own.t));
  const glm::vec3 normal(s.planes[size_t(own.plane)].normal);
  float rise = 0.0f;
  for (int y = -1; y <= 1; ++y)
    for (int x = -1; x <= 1; ++x) {
      const glm::dvec2 there = glm::dvec2(px) + 0.5 + glm::dvec2(x, y);
      const Surface::Seen its = s.seen(there);
      const glm::vec3 way = shared::receiver_point(s.camera, glm::vec2(there), float(its.t)) - p;
      const float its_rise = glm::dot(normal, way);
      if (shared::is_rise(its_rise, p, shared::pixel_width(s.camera, float(own.t))) &&
          shared::bends_up(way, its_rise, normal, glm::vec3(s.planes[size_t(its.plane)].normal)))
        rise = std::max(rise, its_rise);
    }
  return rise;
}

/// How far the micro-quad's corners lie above both planes (below 0: in the ground), in pixel widths; and its centre.
struct Clearance {
  double corners_px = 0.0, center_px = 0.0;
};

Clearance clearance(const Surface& s, const glm::ivec2& px, float rise) {
  const Surface::Seen own = s.seen(glm::dvec2(px) + 0.5);
  const Plane& plane = s.planes[size_t(own.plane)];
  const glm::vec3 p = shared::receiver_point(s.camera, glm::vec2(px) + 0.5f, float(own.t));
  const glm::dvec3 u = glm::normalize(glm::cross(plane.normal, glm::dvec3(0.3, 0.5, 0.8)));
  const glm::dvec3 v = glm::cross(plane.normal, u);
  glm::vec4 data = shared::micro_quad_data(s.camera, glm::vec2(px) + 0.5f, float(own.t), glm::vec3(glm::dvec3(p) + u),
                                           glm::vec3(glm::dvec3(p) - 0.6 * u + v), glm::vec3(glm::dvec3(p) - v));
  data.x = shared::lifted_distance(s.camera, p, glm::vec3(plane.normal), float(own.t), rise);
  const shared::MicroQuad quad = shared::make_micro_quad(s.camera, px, data);
  const double width = double(shared::pixel_width(s.camera, float(own.t)));
  Clearance c{1e300, plane.height(glm::dvec3(quad.center)) / width};
  for (int k = 0; k < 4; ++k)
    for (const Plane& each : s.planes)
      c.corners_px =
          std::min(c.corners_px, each.height(point_in_double(quad, glm::dvec2(shared::corner_offset(k)))) / width);
  return c;
}

/// Two planes, at most `degrees` apart, whose edge passes near the pixel.
Surface random_surface(Random& random, const shared::CameraFrame& camera, const glm::ivec2& px, double degrees) {
  for (;;) {
    Surface s{camera, {}, Shape::valley};
    const glm::dvec3 center(shared::receiver_point(camera, glm::vec2(px) + 0.5f, float(random.uniform(3.0, 30.0))));
    const double width = double(shared::pixel_width(camera, float(-center.z)));
    bool faces = true;
    for (Plane& plane : s.planes) {
      plane = {center + random.point(width), random.direction()};
      const glm::dvec3 view = shared::is_perspective(camera) ? -glm::normalize(center) : glm::dvec3(0, 0, 1);
      if (glm::dot(plane.normal, view) < 0.0) plane.normal = -plane.normal;
      faces = faces && glm::dot(plane.normal, view) > 0.3;
    }
    if (faces && glm::dot(s.planes[0].normal, s.planes[1].normal) > std::cos(glm::radians(degrees))) return s;
  }
}

class SharedLift : public testing::TestWithParam<bool> {
 protected:
  shared::CameraFrame camera = GetParam() ? orthographic_camera() : perspective_camera();
  Random random{211};
  glm::ivec2 random_px() { return {int(random.below(1900)) + 5, int(random.below(1000)) + 5}; }
};

TEST_P(SharedLift, ClearsAValley) {
  int sunk = 0;
  for (int i = 0; i < 4000; ++i) {
    const glm::ivec2 px = random_px();
    const Surface s = random_surface(random, camera, px, 40.0);
    const float rise = highest_rise(s, px);
    // Beyond these the surface is taken for another one.
    bool in_reach = true;
    const Surface::Seen own = s.seen(glm::dvec2(px) + 0.5);
    for (int y = -1; y <= 1; ++y)
      for (int x = -1; x <= 1; ++x) {
        const glm::dvec2 there = glm::dvec2(px) + 0.5 + glm::dvec2(x, y);
        const glm::dvec3 q(shared::receiver_point(camera, glm::vec2(there), float(s.seen(there).t)));
        in_reach = in_reach &&
                   s.planes[size_t(own.plane)].height(q) < 0.999 * double(shared::pixel_width(camera, float(own.t)));
      }
    if (!in_reach) continue;
    const Clearance before = clearance(s, px, 0.0f), after = clearance(s, px, rise);
    sunk += before.corners_px < -0.01;
    EXPECT_GT(after.corners_px, -0.002) << i << ", before "
                                        << before.corners_px;  // perspective turns half-way a little
    EXPECT_GE(after.center_px, -1e-3);
    EXPECT_LT(after.center_px, 0.501);
  }
  EXPECT_GT(sunk, 500);
}

TEST_P(SharedLift, LeavesRidgesFlatsStepsAndCornersAlone) {
  for (int i = 0; i < 2000; ++i) {
    const glm::ivec2 px = random_px();
    Surface s = random_surface(random, camera, px, 40.0);
    s.shape = Shape::ridge;
    EXPECT_EQ(highest_rise(s, px), 0.0f) << i;
    s.planes[1] = s.planes[0];
    EXPECT_EQ(highest_rise(s, px), 0.0f) << i;
  }
  const glm::vec3 up(0, 1, 0), p(0, 0, -10), way(0.01f, 0.005f, 0);
  EXPECT_TRUE(shared::is_rise(0.005f, p, 0.01f));
  EXPECT_FALSE(shared::is_rise(0.011f, p, 0.01f)) << "higher than a pixel is wide";
  EXPECT_FALSE(shared::is_rise(1e-6f, p, 0.01f)) << "rounding";
  EXPECT_FALSE(shared::bends_up(way, 0.005f, up, up)) << "a step";
  EXPECT_TRUE(shared::bends_up(way, 0.005f, up, glm::normalize(glm::vec3(-0.5f, 1, 0))));
  EXPECT_FALSE(shared::bends_up(way, 0.005f, up, glm::vec3(-1, 0, 0))) << "a wall";
  EXPECT_FALSE(shared::bends_up(way, 0.005f, up, glm::vec3(0))) << "no normal";
}

INSTANTIATE_TEST_SUITE_P(Cameras, SharedLift, testing::Bool(),
                         [](const auto& camera) { return camera.param ? "orthographic" : "perspective"; });

}  // namespace
}  // namespace izb::test
