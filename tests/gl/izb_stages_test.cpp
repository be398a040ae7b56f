// SPDX-License-Identifier: MIT
// Stage `zcull` of the technique `izb` alone against the same computed on the CPU; and what the order of insertion may
// change.
#include "gl/built.h"

namespace izb::test {
namespace {

using namespace built;

const std::vector<Settings> zcull_settings{
    {{"grid", "64"}}, {{"grid", "250"}, {"cascades", "3"}}, {{"grid", "1024"}}, {{"grid", "64"}, {"spp", "32"}}};

TEST(IzbZCull, TheDepthBufferIsTheFurthestDepthRoundedUpByOneToTwoSteps) {
  const Scene scene = tangle(104, 200);
  for (const Settings& settings : zcull_settings) {
    const IzbInternals izb = Built(scene, lights()[0], settings).izb;
    ASSERT_EQ(izb.zcull.size(), izb.furthest.size());
    size_t lists = 0;
    for (size_t i = 0; i < izb.furthest.size(); ++i) {
      if (izb.furthest[i] == 0.0f) {
        ASSERT_EQ(izb.zcull[i], 0u) << i;
        continue;
      }
      ++lists;
      const double steps = izb.zcull[i] - 65535.0 * double(izb.furthest[i]), rounding = 0.01;
      ASSERT_GE(steps, 1.0 - rounding) << i;
      ASSERT_LE(steps, 2.0 + rounding) << i;
    }
    EXPECT_GT(lists, 100u);
  }
}

TEST(IzbZCull, EachTexelOfThePyramidIsTheFurthestOfItsSquare) {
  const Scene scene = tangle(105, 200);
  for (const Settings& settings : zcull_settings) {
    const IzbInternals izb = Built(scene, lights()[1], settings).izb;
    for (int level = 0; level < shared::pyramid_levels; ++level) {
      const int side = shared::pyramid_side(izb.grid, level), square = 4 << (2 * level);
      ASSERT_EQ(side, (izb.grid + square - 1) / square);
      std::vector<float> expected(size_t(side) * side * izb.layers, 0.0f);
      const auto at = [&](int x, int y, int layer) { return (size_t(layer) * side + y) * side + x; };
      for (int c = 0; c < izb.layers; ++c)
        for (int y = 0; y < izb.grid; ++y)
          for (int x = 0; x < izb.grid; ++x) {
            float& deepest = expected[at(x / square, y / square, c)];
            deepest = std::max(deepest, izb.furthest[izb.texel({x, y}, c)]);
          }
      for (int c = 0; c < izb.layers; ++c)
        for (int y = 0; y < side; ++y)
          for (int x = 0; x < side; ++x)
            ASSERT_EQ(izb.pyramid_at(level, {x, y}, c), expected[at(x, y, c)]) << level << ": " << x << " " << y;
    }
  }
}

/// Expects the same lists but for their order, and that this differs.
void expect_other_order(const IzbInternals& a, const IzbInternals& b) {
  ASSERT_EQ(a.lists.count(), b.lists.count());
  size_t several = 0, other_order = 0;
  for (size_t i = 0; i < a.lists.count(); ++i) {
    std::vector<uint32_t> one(a.lists[i].begin(), a.lists[i].end()), other(b.lists[i].begin(), b.lists[i].end());
    several += one.size() > 1;
    other_order += one != other;
    std::sort(one.begin(), one.end()), std::sort(other.begin(), other.end());
    ASSERT_EQ(one, other) << i;
  }
  EXPECT_GT(several, 100u);
  EXPECT_GT(other_order,
            several / 8);  // where threads run side by side, many lists keep theirs: on an H200 four fifths
}

// Coprime to the number of pixels: backwards, and scattered.
const int strides[] = {width_px * height_px - 1, 1001};

TEST(IzbOrder, OfInsertionAndDrawingDoesNotChangeTheBruteForceMask) {
  const Scene scene = tangle(106, 300);
  Scene backwards = scene;
  for (Mesh& mesh : backwards.meshes) std::reverse(mesh.indices.begin(), mesh.indices.end());
  std::swap(backwards.meshes[0], backwards.meshes[1]);
  for (const Light& light : lights())
    for (const Settings& settings :
         {Settings{{"grid", "128"}}, Settings{{"grid", "128"}, {"removal", "off"}, {"pipelining", "on"}}}) {
      const Built base(scene, light, settings);
      EXPECT_EQ(different(base.frame.mask, brute_force_mask(base.frame)), 0u);
      EXPECT_GT(shadowed(base.frame), 100u);
      for (const int stride : strides) {
        const Built permuted(scene, light, settings, stride);
        expect_other_order(base.izb, permuted.izb);
        EXPECT_EQ(different(base.frame.mask, permuted.frame.mask), 0u) << stride;
        const Built both(backwards, light, settings, stride);
        EXPECT_EQ(different(both.frame.mask, brute_force_mask(both.frame)), 0u) << stride;
      }
    }
}

TEST(IzbOrder, OfInsertionDoesNotChangeTheMaskOf32Samples) {
  const Scene scene = tangle(107, 300);
  const Settings exact{{"spp", "32"}, {"coverage", "exact"}, {"insertion", "exact"}, {"grid", "256"}};
  const Settings approximate{{"spp", "32"}, {"grid", "256"}};
  for (const Settings& settings : {exact, with(exact, {{"removal", "off"}}), approximate}) {
    const Built base(scene, lights()[0], settings);
    for (const int stride : strides) {
      const Built permuted(scene, lights()[0], settings, stride);
      expect_other_order(base.izb, permuted.izb);
      EXPECT_EQ(different(base.frame.mask, permuted.frame.mask), 0u) << stride;
    }
  }
}

}  // namespace
}  // namespace izb::test
