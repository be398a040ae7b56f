// SPDX-License-Identifier: MIT
#include "reference/settle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "reference/candidates.h"
#include "reference/exact.h"
#include "reference/witness.h"
#include "reference_fixture.h"

namespace izb::reference {
namespace {

constexpr float band = 1.0f / 1024.0f;
const LightPoint sun_up{{0.0f, 1.0f, 0.0f}, false};
const LightPoint slanted{{0.7f, 1.0f, 0.3f}, false};

// One receiver with a planted error: the mask has the opposite of the exact truth, which the ray has.
Verdict verdict_of_flip(const Triangles& triangles, const LightPoint& light, const glm::vec3& point, bool expect_shadow,
                        uint32_t own = no_own_triangle) {
  Receivers receivers;
  add_receiver(receivers, point, band, own);
  const std::vector<uint32_t> truth = exact_mask(triangles, light, receivers);
  EXPECT_EQ(truth[0] == dark, expect_shadow);
  const std::vector<uint32_t> flipped{~truth[0]};
  const Settled settled = settle(triangles, light, receivers, flipped, truth);
  EXPECT_EQ(settled.disputed, 1u);
  EXPECT_EQ(settled.leaks, expect_shadow ? 1u : 0u);
  EXPECT_EQ(settled.false_shadow, expect_shadow ? 0u : 1u);
  return settled.verdicts[0];
}

class PlantedErrors : public testing::Test {
 protected:
  PlantedErrors() { add_rectangle(triangles, -1.0f, 1.0f, -1.0f, 1.0f, 2.0f); }
  Triangles triangles;
};

TEST_F(PlantedErrors, FarFromAnyEdgeAreUnexplained) {
  EXPECT_EQ(verdict_of_flip(triangles, sun_up, {0.5f, 0, -0.25f}, true), Verdict::unexplained);
  EXPECT_EQ(verdict_of_flip(triangles, sun_up, {3.0f, 0, 0}, false), Verdict::unexplained);
  EXPECT_EQ(verdict_of_flip(triangles, sun_up, {1.0f - 2.0f * band, 0, 0.5f}, true), Verdict::unexplained);
  EXPECT_EQ(verdict_of_flip(triangles, sun_up, {1.0f + 1.5f * band, 0, 0.5f}, false), Verdict::unexplained);
}

TEST_F(PlantedErrors, WithinTheBandOfTheOutlineAreExplained) {
  for (const float distance : {0.9f, 0.5f, 0.01f, 0.0f})
    EXPECT_EQ(verdict_of_flip(triangles, sun_up, {1.0f - distance * band, 0, 0.5f}, true), Verdict::explained);
  for (const float distance : {0.9f, 0.5f, 0.01f})
    EXPECT_EQ(verdict_of_flip(triangles, sun_up, {1.0f + distance * band, 0, 0.5f}, false), Verdict::explained);
  // Near a corner the band is a circle, not the crossing of two strips.
  EXPECT_EQ(verdict_of_flip(triangles, sun_up, {1.0f + 0.9f * band, 0, 1.0f + 0.9f * band}, false),
            Verdict::unexplained);
  EXPECT_EQ(verdict_of_flip(triangles, sun_up, {1.0f + 0.7f * band, 0, 1.0f + 0.7f * band}, false), Verdict::explained);
}

TEST_F(PlantedErrors, OnAnInnerSharedEdgeAreUnexplained) {
  EXPECT_EQ(verdict_of_flip(triangles, sun_up, {0.5f, 0, 0.5f}, true), Verdict::unexplained);
  EXPECT_EQ(verdict_of_flip(triangles, sun_up, {0.5f, 0, 0.5f + 0.1f * band}, true), Verdict::unexplained);
}

TEST_F(PlantedErrors, AtAThinGapAreExplained) {
  Triangles gap;
  const float width = 1e-4f * band;  // representable around 0
  add_rectangle(gap, -1.0f, 0.0f, -1.0f, 1.0f, 2.0f);
  add_rectangle(gap, width, 1.0f, -1.0f, 1.0f, 3.0f);
  EXPECT_EQ(verdict_of_flip(gap, sun_up, {-0.5f * band, 0, 0.25f}, true), Verdict::explained);
  Triangles closed;
  add_rectangle(closed, -1.0f, 0.0f, -1.0f, 1.0f, 2.0f);
  add_rectangle(closed, 0.0f, 1.0f, -1.0f, 1.0f, 3.0f);
  EXPECT_EQ(verdict_of_flip(closed, sun_up, {-0.5f * band, 0, 0.25f}, true), Verdict::unexplained);
}

TEST_F(PlantedErrors, BetweenThreeOccludersAreExplained) {
  // Three half-planes leave a lit triangle 0.02 bands wide: only crossings of lines find it.
  Triangles iris;
  const auto add_half_plane = [&](float angle, float offset, float y) {
    const glm::vec3 n{std::cos(angle), 0, std::sin(angle)}, t{-n.z, 0, n.x}, at{0.4f * band, y, 0};
    const glm::vec3 foot = at + offset * n;
    add_triangle(iris, foot - 2.0f * t, foot + 2.0f * t, foot + 4.0f * n);
  };
  for (int i = 0; i < 3; ++i)
    add_half_plane(0.3f + 2.0943951f * static_cast<float>(i), 0.005f * band, 2.0f + static_cast<float>(i));
  EXPECT_EQ(verdict_of_flip(iris, sun_up, {0, 0, 0}, true), Verdict::explained);
  EXPECT_EQ(verdict_of_flip(iris, sun_up, {2.0f * band, 0, 0}, true), Verdict::unexplained);
}

TEST_F(PlantedErrors, ALitWedgeBeyondTheBandExplainsNothing) {
  // Two edges cross half a band away at a small angle; the lit wedge between them is covered up to 1.2 bands.
  const auto z = [](float x) { return 1e-3f * (x - 0.5f * band); };
  Triangles wedge;
  add_triangle(wedge, {-1, 2, z(-1)}, {1, 2, z(1)}, {0, 2, 5});
  add_triangle(wedge, {-1, 2, -z(-1)}, {1, 2, -z(1)}, {0, 2, -5});
  EXPECT_EQ(verdict_of_flip(wedge, sun_up, {0, 0, 0}, true), Verdict::explained);
  add_rectangle(wedge, -1.0f, 1.2f * band, -1.0f, 1.0f, 3.0f);
  EXPECT_EQ(verdict_of_flip(wedge, sun_up, {0, 0, 0}, true), Verdict::unexplained);
}

TEST_F(PlantedErrors, AShadowBetweenAnEdgeAndATiltedPlaneExplains) {
  // The triangle covers x >= 0.3 bands but is above the floor only where z > x - 0.1 bands: the nearest point
  // of its edge is lit, and what it shadows of the disc begins at the crossing of the two lines.
  const auto on_plane = [](float x, float z) { return glm::vec3(x, 0.1f * band - x + z, z); };
  Triangles tilted;
  add_triangle(tilted, on_plane(0.3f * band, -1), on_plane(0.3f * band, 1), on_plane(2, 0));
  EXPECT_EQ(verdict_of_flip(tilted, sun_up, {0, 0, 0}, false), Verdict::explained);
  // With the plane below the point it is the plane that would have to explain.
  for (glm::vec3& v : tilted.positions_vs) v.y -= 0.2f * band;
  EXPECT_EQ(verdict_of_flip(tilted, sun_up, {0, 0, 0}, false), Verdict::unexplained);
}

TEST_F(PlantedErrors, FalseShadowIsNeverExplainedByAPlane) {
  // A duplicate of the floor lies a little below the point, or passes through it. A step across the slanted
  // light would dive below it.
  for (const float depth : {0.0f, 1e-3f * band, 0.1f * band, 0.5f * band}) {
    Triangles duplicate;
    add_rectangle(duplicate, -5.0f, 5.0f, -5.0f, 5.0f, -depth);
    EXPECT_EQ(verdict_of_flip(duplicate, slanted, {0.2f, 0, 0.1f}, false), Verdict::unexplained) << depth;
    EXPECT_EQ(verdict_of_flip(duplicate, {{3, 9, 2}, true}, {0.2f, 0, 0.1f}, false), Verdict::unexplained) << depth;
  }
}

TEST_F(PlantedErrors, LeakThroughAPlaneIsExplainedWithinTheBandOnly) {
  for (const LightPoint& light : {sun_up, slanted, LightPoint{{3, 9, 2}, true}}) {
    Triangles above;
    add_rectangle(above, -5.0f, 5.0f, -5.0f, 5.0f, 0.5f * band);
    EXPECT_EQ(verdict_of_flip(above, light, {0.2f, 0, 0.1f}, true), Verdict::explained);
    Triangles high;
    add_rectangle(high, -5.0f, 5.0f, -5.0f, 5.0f, 1.5f * band);
    EXPECT_EQ(verdict_of_flip(high, light, {0.2f, 0, 0.1f}, true), Verdict::unexplained);
  }
}

TEST_F(PlantedErrors, WorkTheSameUnderALamp) {
  // The lamp at height 4 doubles the roof at height 2: the outline on the floor is at 2.
  const LightPoint lamp{{0, 4, 0}, true};
  EXPECT_EQ(verdict_of_flip(triangles, lamp, {2.0f - 0.5f * band, 0, 0.5f}, true), Verdict::explained);
  EXPECT_EQ(verdict_of_flip(triangles, lamp, {2.0f + 0.5f * band, 0, 0.5f}, false), Verdict::explained);
  EXPECT_EQ(verdict_of_flip(triangles, lamp, {2.0f - 2.0f * band, 0, 0.5f}, true), Verdict::unexplained);
  EXPECT_EQ(verdict_of_flip(triangles, lamp, {2.0f + 2.0f * band, 0, 0.5f}, false), Verdict::unexplained);
  EXPECT_EQ(verdict_of_flip(triangles, lamp, {1.0f, 0, 1.0f}, true), Verdict::unexplained);  // the diagonal
  EXPECT_EQ(verdict_of_flip(triangles, {{0, 1, 0}, true}, {0.5f, 0, 0.5f}, false), Verdict::unexplained);
}

TEST_F(PlantedErrors, OwnTriangleExplainsNothing) {
  EXPECT_EQ(verdict_of_flip(triangles, sun_up, {1.0f - 0.5f * band, 0, -0.5f}, true), Verdict::explained);
  EXPECT_EQ(verdict_of_flip(triangles, sun_up, {1.0f - 0.5f * band, 0, -0.5f}, false, 0), Verdict::unexplained);
}

TEST(Settle, CountsAndRecords) {
  Triangles triangles;
  add_rectangle(triangles, -1.0f, 1.0f, -1.0f, 1.0f, 2.0f);
  Receivers receivers;
  add_receiver(receivers, {0.5f, 0, 0}, band);  // agreed, shadowed
  add_receiver(receivers, {1.0f + 0.5f * band, 0, 0},
               band);                                // explained false shadow, 0.5 bands from the edge
  add_receiver(receivers, {0.75f, 0, 0.25f}, band);  // unexplained leak
  add_receiver(receivers, {5, 0, 0}, band);          // the ray is wrong
  add_receiver(receivers, {5, 0, 0}, band);          // not compared, though different
  add_receiver(receivers, {5, 0, 0}, band);
  add_receiver(receivers, {5, 0, 0}, band);
  receivers.classes[4] = PixelClass::sky;
  receivers.classes[5] = PixelClass::culled;
  receivers.classes[6] = PixelClass::outside_cone;
  const std::vector<uint32_t> mask{dark, dark, 0, 0, dark, 0, 0}, rays{dark, 0, dark, dark, 0, dark, 0};
  const Settled s = settle(triangles, sun_up, receivers, mask, rays);
  EXPECT_EQ(s.compared, 4u);
  EXPECT_EQ(s.lit, 2u);
  EXPECT_EQ(s.shadowed, 2u);
  EXPECT_EQ(s.sky, 1u);
  EXPECT_EQ(s.culled, 1u);
  EXPECT_EQ(s.outside_cone, 1u);
  EXPECT_EQ(s.disputed, 3u);
  EXPECT_EQ(s.settled_ours, 1u);
  EXPECT_EQ(s.explained, 1u);
  EXPECT_EQ(s.unexplained, 1u);
  EXPECT_EQ(s.leaks, 1u);
  EXPECT_EQ(s.false_shadow, 1u);
  EXPECT_EQ(s.verdicts,
            (std::vector<Verdict>{Verdict::agreed, Verdict::explained, Verdict::unexplained, Verdict::settled_ours,
                                  Verdict::not_compared, Verdict::not_compared, Verdict::not_compared}));
  ASSERT_EQ(s.records.size(), 2u);
  EXPECT_EQ(s.records[0].receiver, 2u);
  EXPECT_TRUE(s.records[0].leak);
  EXPECT_NEAR(s.records[0].edge_distance_bands, 0.25 / band, 1e-6 / band);
  EXPECT_EQ(s.records[1].receiver, 1u);
  EXPECT_FALSE(s.records[1].leak);
  EXPECT_NEAR(s.records[1].edge_distance_bands, 0.5, 1e-3);
  EXPECT_EQ(settle(triangles, sun_up, receivers, mask, rays, 1).records.size(), 1u);
  EXPECT_THROW(settle(triangles, sun_up, receivers, std::vector<uint32_t>(6), rays), Error);
}

// Sample s lies s 64ths of a unit to the right of the first; an orthographic camera looks down on the floor.
Receivers row_of_samples(const glm::vec3& first) {
  Receivers receivers;
  add_receiver(receivers, first, band);
  receivers.offsets_px.clear();
  for (int s = 0; s < 32; ++s) receivers.offsets_px.emplace_back(s / 64.0, 0.0);
  receivers.camera = {{1.0, 1.0}, false};
  receivers.slopes.emplace_back(0.0);
  return receivers;
}

TEST(SettleSamples, OneWrongBitOf32IsFound) {
  // The roof's edge stands at x = 1, half a band beyond sample 16, and 15 bands before sample 17.
  Triangles triangles;
  add_rectangle(triangles, -1.0f, 1.0f, -4.0f, 1.0f, 2.0f);
  const float edge_to_sample = 0.5f * band;
  const Receivers receivers = row_of_samples({0.75f - edge_to_sample, 0, -0.25f});
  const std::vector<uint32_t> truth = exact_mask(triangles, sun_up, receivers);
  ASSERT_EQ(truth[0], 0x1ffffu);
  struct Planted {
    uint8_t sample;
    Verdict verdict;
    bool leak;
  };
  for (const Planted& planted : {Planted{3, Verdict::unexplained, true}, Planted{16, Verdict::explained, true},
                                 Planted{17, Verdict::unexplained, false}, Planted{31, Verdict::unexplained, false}}) {
    const std::vector<uint32_t> mask{truth[0] ^ 1u << planted.sample};
    const Settled s = settle(triangles, sun_up, receivers, mask, truth);
    EXPECT_EQ(s.compared, 32u);
    EXPECT_EQ(s.shadowed, planted.leak ? 16u : 18u);
    EXPECT_EQ(s.lit, 32u - s.shadowed);
    EXPECT_EQ(s.disputed, 1u);
    EXPECT_EQ(s.leaks, planted.leak ? 1u : 0u);
    EXPECT_EQ(s.false_shadow, planted.leak ? 0u : 1u);
    EXPECT_EQ(s.unexplained, planted.verdict == Verdict::unexplained ? 1u : 0u);
    EXPECT_EQ(s.explained, planted.verdict == Verdict::explained ? 1u : 0u);
    EXPECT_EQ(s.verdicts[0], planted.verdict);
    ASSERT_EQ(s.records.size(), 1u);
    EXPECT_EQ(s.records[0].sample, planted.sample);
    EXPECT_EQ(s.records[0].verdict, planted.verdict);
  }
}

TEST(SettleSamples, AReceiverHasTheWorstOfItsBits) {
  Triangles triangles;
  add_rectangle(triangles, -1.0f, 1.0f, -4.0f, 1.0f, 2.0f);
  const Receivers receivers = row_of_samples({0.75f - 0.5f * band, 0, -0.25f});
  const std::vector<uint32_t> truth = exact_mask(triangles, sun_up, receivers);
  // An unexplained bit before an explained one and one that the ray has wrong, in the order of the samples.
  const Settled s = settle(triangles, sun_up, receivers, std::vector<uint32_t>{truth[0] ^ 1u << 2 ^ 1u << 16},
                           std::vector<uint32_t>{truth[0] ^ 1u << 20});
  EXPECT_EQ(s.disputed, 3u);
  EXPECT_EQ(s.unexplained, 1u);
  EXPECT_EQ(s.explained, 1u);
  EXPECT_EQ(s.settled_ours, 1u);
  EXPECT_EQ(s.verdicts[0], Verdict::unexplained);
  ASSERT_EQ(s.records.size(), 2u);
  EXPECT_EQ(s.records[0].sample, 2u);
  EXPECT_EQ(s.records[1].sample, 16u);
}

TEST(SettleSamples, MasksOfManySamplesAreComparedOnReceiversOnly) {
  Triangles triangles;
  add_rectangle(triangles, -1.0f, 1.0f, -1.0f, 1.0f, 2.0f);
  Receivers receivers = row_of_samples({5, 0, 0});
  receivers.classes[0] = PixelClass::culled;
  const Settled s = settle(triangles, sun_up, receivers, std::vector<uint32_t>{0x0f0f0f0fu}, std::vector<uint32_t>{0});
  EXPECT_EQ(s.culled, 1u);
  EXPECT_EQ(s.compared + s.disputed, 0u);
}

Triangles soup(uint32_t seed, int count, double size) {
  Random random(seed);
  Triangles triangles;
  for (int i = 0; i < count; ++i) {
    const glm::vec3 at = random.point(-4.0, 4.0);
    add_triangle(triangles, at, at + random.point(-size, size), at + random.point(-size, size));
  }
  return triangles;
}

const LightPoint lights[] = {{{0.7f, 1.0f, 0.3f}, false},
                             {{1e-3f, -2e-4f, 3e-3f}, false},
                             {{0.1f, 0.3f, -0.2f}, true},
                             {{40.0f, 90.0f, -20.0f}, true}};

TEST(Settle, CandidatesMissNoOccluder) {
  // Triangles all around the lamp, large and small, some of them through its cube's edges.
  for (const LightPoint& light : lights) {
    Triangles triangles = soup(7, 2000, 0.3);
    const Triangles large = soup(8, 50, 20.0);
    for (const glm::vec3& v : large.positions_vs) triangles.positions_vs.push_back(v);
    Random random(9);
    std::vector<Ball> balls;
    for (int i = 0; i < 300; ++i)
      balls.push_back({random.point(-4.0, 4.0), static_cast<float>(std::exp2(random.uniform(-12.0, -3.0))), 5});
    balls.push_back({light.positional ? light.xyz_vs + glm::vec3(1e-4f) : glm::vec3(0), 1e-3f, 5});
    const Candidates candidates = find_candidates(triangles, light, balls);
    size_t needed = 0;
    for (size_t i = 0; i < balls.size(); ++i) {
      const auto list = candidates.of(i);
      EXPECT_TRUE(std::is_sorted(list.begin(), list.end()));
      EXPECT_EQ(std::adjacent_find(list.begin(), list.end()), list.end());
      EXPECT_FALSE(std::binary_search(list.begin(), list.end(), 5u));
      for (int k = 0; k < 4; ++k) {
        glm::dvec3 step(random.point(-1.0, 1.0));
        step *= (k == 0 ? 0.0 : 0.999 * balls[i].radius / glm::length(step));
        for (uint32_t t = 0; t < triangles.count(); ++t)
          if (t != 5 && occluded_exact(glm::dvec3(balls[i].center_vs) + step, corners(triangles, t), light)) {
            ++needed;
            EXPECT_TRUE(std::binary_search(list.begin(), list.end(), t)) << i << " " << t;
          }
      }
    }
    EXPECT_GT(needed, 1000u);
    EXPECT_LT(candidates.triangles.size(),
              balls.size() * triangles.count() / 4);  // it is a search, not all pairs
  }
}

TEST(Settle, CandidatesIncludeATriangleThatAlmostTouchesTheLamp) {
  const LightPoint lamp{{0.1f, 0.3f, -0.2f}, true};
  Triangles ceiling;
  add_rectangle(ceiling, -20.0f, 20.0f, -20.0f, 20.0f, 0.3f - 1e-4f);
  const std::vector<Ball> balls{{{-3, -1, 2}, 1e-3f, no_own_triangle}, {{3, -1, -2}, 1e-3f, no_own_triangle}};
  const Candidates candidates = find_candidates(ceiling, lamp, balls);
  for (size_t i = 0; i < balls.size(); ++i) {
    const uint32_t over = occluded_exact(balls[i].center_vs, corners(ceiling, 0), lamp) ? 0 : 1;
    ASSERT_TRUE(occluded_exact(balls[i].center_vs, corners(ceiling, over), lamp));
    const auto list = candidates.of(i);
    EXPECT_TRUE(std::binary_search(list.begin(), list.end(), over));
  }
}

TEST(Settle, FindsAWitnessWhereThereIsOne) {
  // For random points P and Q in a band, wherever the truth differs by edges alone, a witness must be found
  // from P.
  for (const LightPoint& light : lights) {
    const Triangles triangles = soup(3, 3000, 0.2);
    Random random(4);
    int differing = 0;
    std::vector<Corners> all;
    for (uint32_t t = 0; t < triangles.count(); ++t) all.push_back(corners(triangles, t));
    for (int i = 0; i < 400; ++i) {
      const glm::dvec3 p(random.point(-4.0, 4.0));
      const glm::dvec3 d = light.positional ? glm::dvec3(light.xyz_vs) - p : glm::dvec3(light.xyz_vs);
      glm::dvec3 step(random.point(-1.0, 1.0));
      step -= d * (glm::dot(step, d) / glm::dot(d, d));
      const double radius = 0.02;
      const glm::dvec3 q = p + step * (0.9 * radius / glm::length(step));
      const bool truth = shadowed_exact(p, all, light);
      std::vector<Corners> casting;
      for (const Corners& t : all)
        if (truth || plane_between_exact(p, t, light)) casting.push_back(t);
      if (shadowed_exact(q, casting, light) == truth) continue;
      ++differing;
      EXPECT_TRUE(truth_changes_within(p, radius, truth, casting, light)) << i;
    }
    EXPECT_GT(differing, 10);
  }
}

}  // namespace
}  // namespace izb::reference
