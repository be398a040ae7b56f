// SPDX-License-Identifier: MIT
// What the research harness judges: shares of light, and which pixels one plane is a fair model of.
#include <bit>

#include "app/bench/lit_share.h"
#include "gl/frame_fixture.h"
#include "shadow/renderer.h"

namespace izb::test {
namespace {

constexpr int width_px = 96, height_px = 72;

/// A scene from above, where one pixel is about 0.1 units wide.
struct Seen {
  std::unique_ptr<Technique> technique = make_technique("izb");
  Renderer renderer;

  explicit Seen(const Scene& scene) : renderer(scene, capabilities()) {
    const std::vector<Light> lights{sun(130, 60)};
    gpu::StageTimers timers(true);
    renderer.prepare(*technique, width_px, height_px, lights);
    renderer.render(look_at({0.0, 8.0, 0.01}, {0, 0, 0}, glm::radians(45.0)), lights, timers);
  }
};

size_t count(const std::vector<uint8_t>& pixels) {
  return static_cast<size_t>(std::count(pixels.begin(), pixels.end(), uint8_t{1}));
}

size_t at(int x, int y) {
  return size_t(y) * width_px + size_t(x);
}

/// A sheet of folds, each so many units deep and wide.
std::vector<glm::vec3> folds(float depth, float width, int number) {
  std::vector<glm::vec3> sheet;
  for (int i = -number; i < number; ++i) {
    const float x = float(i) * width, y0 = i % 2 ? depth : 0.0f, y1 = i % 2 ? 0.0f : depth;
    const glm::vec3 a{x, y0, -9}, b{x + width, y1, -9}, c{x, y0, 9}, d{x + width, y1, 9};
    sheet.insert(sheet.end(), {a, c, b, b, c, d});
  }
  return sheet;
}

TEST(BenchPixels, AnEmptyFloorIsFlatAndLit) {
  Scene scene = empty_scene();
  add_soup(scene, floor_of(30.0f));
  const Seen seen(scene);
  // All but the picture's border, whose neighbours are not seen.
  EXPECT_EQ(count(bench::flat_pixels(seen.renderer)), size_t(width_px - 2) * (height_px - 2));
  EXPECT_EQ(count(bench::receivers_of(seen.renderer)), size_t(width_px) * height_px);
  for (const float lit : bench::lit_share(seen.renderer)) EXPECT_EQ(lit, 1.0f);
}

TEST(BenchPixels, TheEdgeOfARoofIsNotFlatAndBelowItIsNoLight) {
  Scene scene = empty_scene();
  add_soup(scene, floor_of(30.0f));
  add_soup(scene, {{-1, 1, -1}, {-1, 1, 1}, {1, 1, -1}, {1, 1, -1}, {-1, 1, 1}, {1, 1, 1}});
  const Seen seen(scene);
  const std::vector<uint8_t> flat = bench::flat_pixels(seen.renderer);
  EXPECT_EQ(flat[at(width_px / 2, height_px / 2)], 1) << "the roof's middle";
  EXPECT_EQ(flat[at(5, 5)], 1) << "the floor far from it";
  const size_t inside = size_t(width_px - 2) * (height_px - 2), edges = inside - count(flat);
  // Two pixels along each side of the roof, some 25 pixels long.
  EXPECT_GT(edges, 150u);
  EXPECT_LT(edges, 260u);
  const std::vector<float> lit = bench::lit_share(seen.renderer);
  const std::vector<uint32_t> mask = seen.renderer.read_mask();
  size_t dark = 0, between = 0;
  for (size_t i = 0; i < lit.size(); ++i) {
    EXPECT_EQ(lit[i], 1.0f - float(std::popcount(mask[i])) / 32.0f);
    dark += lit[i] == 0.0f;
    between += lit[i] > 0.0f && lit[i] < 1.0f;
  }
  EXPECT_GT(dark, 50u);
  EXPECT_GT(between, 10u);
}

TEST(BenchPixels, FoldsWithinAPixelAreNotFlat) {
  Scene deep = empty_scene(), shallow = empty_scene();
  add_soup(deep, folds(0.03f, 0.04f, 300));
  add_soup(shallow, folds(0.0001f, 0.04f, 300));
  const size_t inside = size_t(width_px - 2) * (height_px - 2);
  EXPECT_LT(count(bench::flat_pixels(Seen(deep).renderer)), inside / 20);
  EXPECT_EQ(count(bench::flat_pixels(Seen(shallow).renderer)), inside) << "less than 1/64 of a pixel";
}

TEST(BenchPixels, WhatTurnsAwayOrIsSkyIsDark) {
  Scene scene = empty_scene();
  // A wall that the camera sees and the light, from the side of x > 0 and z > 0, does not.
  add_soup(scene, {{-9, -4, -9}, {-9, -4, 0}, {0, 4, -9}, {0, 4, -9}, {-9, -4, 0}, {0, 4, 0}});
  const Seen seen(scene);
  const std::vector<uint8_t> receivers = bench::receivers_of(seen.renderer);
  const std::vector<float> lit = bench::lit_share(seen.renderer);
  EXPECT_LT(count(receivers), receivers.size());
  for (size_t i = 0; i < lit.size(); ++i) EXPECT_TRUE(receivers[i] || lit[i] == 0.0f) << i;
}

}  // namespace
}  // namespace izb::test
