// SPDX-License-Identifier: MIT
// The same scene far from the origin, and a thousand times larger or smaller: the same mask, but for bits that rounding
// may decide either way.
#include "gl/frame_fixture.h"

namespace izb::test {
namespace {

constexpr int width_px = 96, height_px = 64;
const glm::dvec3 eye(4.0, 5.0, 7.0), target(0.0, 0.6, 0.0);

/// world = offset + scale * point.
struct Move {
  const char* name;
  glm::dvec3 offset;
  double scale;

  glm::dvec3 of(const glm::dvec3& p) const { return offset + scale * p; }
  glm::dmat4 matrix() const { return glm::scale(glm::translate(glm::dmat4(1.0), offset), glm::dvec3(scale)); }
};

const Move moves[] = {{"far away", {1e6, -1e6, 1e6}, 1.0},
                      {"along one axis", {0.0, 1e6, 0.0}, 1.0},
                      {"small", {0.0, 0.0, 0.0}, 1e-3},
                      {"large", {0.0, 0.0, 0.0}, 1e3},
                      {"large and far away", {1e6, 0.0, -1e6}, 1e3}};

/// As a file would have it: instances below one root node.
Scene moved(Scene scene, const Move& move) {
  for (Instance& instance : scene.instances) instance.world_from_object = move.matrix() * instance.world_from_object;
  return scene;
}

Camera moved_camera(const Move& move) {
  return look_at(move.of(eye), move.of(target), glm::radians(50.0));
}

Light moved(Light light, const Move& move) {
  light.position_ws = move.of(light.position_ws);
  return light;
}

void check(const Settings& settings) {
  Scene scene = tangle(150, 250);
  // Turned, so that no product is exact by chance.
  for (Instance& instance : scene.instances)
    instance.world_from_object = glm::rotate(instance.world_from_object, 0.1, glm::dvec3(0.0, 1.0, 0.0));
  const Move stay{"", glm::dvec3(0.0), 1.0};
  for (const Light& light : {sun(130, 35), point_light({0.4, 1.7, 0.9})}) {
    const Frame base = render_frame(scene, moved_camera(stay), light, width_px, height_px, settings);
    expect_explained(base);
    for (const Move& move : moves) {
      SCOPED_TRACE(move.name);
      const Frame other =
          render_frame(moved(scene, move), moved_camera(move), moved(light, move), width_px, height_px, settings);
      expect_explained(other);
      // Where the masks differ, the truth takes both values within the band.
      const reference::Settled settled =
          reference::settle(reference::Triangles{base.triangles_vs}, base.light, base.receivers, other.mask, base.mask);
      EXPECT_EQ(settled.unexplained, 0u);
      EXPECT_LT(settled.disputed, settled.compared / 1000);
    }
  }
}

TEST(Far, TheMaskIsTheSame) {
  check({{"grid", "256"}});
}

TEST(Far, TheMaskOf32SamplesIsTheSame) {
  check({{"spp", "32"}, {"coverage", "exact"}, {"insertion", "exact"}, {"grid", "128"}});
}

}  // namespace
}  // namespace izb::test
