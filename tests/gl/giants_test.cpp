// SPDX-License-Identifier: MIT
// The room `izb` with triangles 10^4 times larger than the light's window, none of them in view.
#include <limits>

#include "gl/frame_fixture.h"

namespace izb::test {
namespace {

constexpr int width_px = 96, height_px = 64;

/// The largest distance from a corner of triangle `k` to the receivers' window, across the light, over the window's
/// side.
double ratio(const Frame& frame, size_t k) {
  const shared::LightFrame& light = frame.inputs.light;
  const double side = double(light.grid.x) / std::min(double(frame.window.window.z), double(frame.window.window.w));
  double longest = 0.0;
  for (size_t corner = 0; corner < 3; ++corner) {
    const glm::dvec3 edge =
        glm::dvec3(frame.triangles_vs[3 * k + corner]) - glm::dvec3(frame.triangles_vs[3 * k + (corner + 1) % 3]);
    const glm::dvec3 x = glm::vec3(light.axis_x), y = glm::vec3(light.axis_y);
    longest = std::max(longest, std::hypot(glm::dot(edge, x), glm::dot(edge, y)));
  }
  return longest / side;
}

TEST(Giants, OutOfViewAndTenThousandTimesTheWindowCastTheBruteForceMask) {
  const Camera camera = look_at({1.0, 2.0, 1.5}, {0, 0, 0}, glm::radians(60.0));
  for (const Light& light : {sun(130, 60), sun(70, 35)})
    for (uint32_t seed = 0; seed < 3; ++seed) {
      Random random(70 + seed);
      Scene scene = empty_scene();
      add_soup(scene, floor_of(12.0f, 3));
      constexpr int giants = 12;
      std::vector<glm::vec3> soup;
      for (int i = 0; i < giants; ++i) {
        // One edge crosses the light's way to the middle of the picture at height 5 to 9, above the camera; the
        // triangle lies level on one side of it, so that the others still leave light.
        const glm::dvec3 across = glm::normalize(random.direction() * glm::dvec3(1, 0, 1));
        const glm::dvec3 aside(-across.z, 0.0, across.x);
        const double height = random.uniform(5.0, 9.0), reach = 3.0e5;
        const glm::dvec3 on = -light.direction_ws * (height / -light.direction_ws.y) + aside * random.uniform(0.3, 2.0);
        soup.emplace_back(on - across * reach);
        soup.emplace_back(on + across * reach);
        soup.emplace_back(on + aside * random.uniform(0.2, 1.0) + across * random.uniform(-1.0, 1.0));
      }
      add_soup(scene, soup);
      const Frame frame = render_frame(scene, camera, light, width_px, height_px, {{"grid", "512"}});
      const size_t first = frame.triangles_vs.size() / 3 - giants;
      for (size_t k = first; k < first + giants; ++k) EXPECT_GE(ratio(frame, k), 1e4) << k;
      for (const uint32_t own : frame.receivers.own_triangle)
        EXPECT_TRUE(own < first || own == std::numeric_limits<uint32_t>::max()) << "giant " << own << " is in view";
      EXPECT_EQ(different(frame.mask, brute_force_mask(frame)), 0u) << "seed " << seed;
      EXPECT_GT(shadowed(frame), 50u);
      EXPECT_LT(shadowed(frame), receivers(frame));
      expect_explained(frame);
    }
}

}  // namespace
}  // namespace izb::test
