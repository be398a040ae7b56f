// SPDX-License-Identifier: MIT
// The lens: what hides a pixel's samples, where the answer is known beforehand.
#include <gtest/gtest.h>

#include <bit>
#include <chrono>
#include <cstdio>

#include "shared/coverage.h"
#include "shared/lists.h"
#include "view/pixel_probe.h"
#include "view_fixture.h"

namespace izb::test {
namespace {

using Triangles = std::vector<glm::vec3>;

/// Over the whole of view space's x below `x`, at height z.
void add_left_of(Triangles& triangles, float x, float z) {
  for (const glm::vec3& v : {glm::vec3(x, -1000, z), glm::vec3(x, 1000, z), glm::vec3(x - 1000, 0, z)})
    triangles.push_back(v);
}

/// Of the pixel at (1, 1) in a picture of 4 x 3, whose centre is at (1.5, 1.5).
ProbedPixel probed(const Snapshot& s, const Triangles& triangles) {
  return probe(s, triangles, {1, 1});
}

uint32_t bits_left_of(const Snapshot& s, float offset_px) {
  uint32_t bits = 0;
  for (size_t n = 0; n < s.samples.offsets_px.size(); ++n)
    if (s.samples.offsets_px[n].x <= offset_px) bits |= 1u << n;
  return bits;
}

TEST(ViewProbe, AnOccludersLinesAndBitsAreThoseOfItsShadow) {
  const Snapshot s = floor_from_above(4, 3);
  Triangles triangles;
  add_left_of(triangles, 1.6f, -5.0f);   // hides what is left of 0.1 px
  add_left_of(triangles, 1.6f, -11.0f);  // below the floor
  const ProbedPixel p = probed(s, triangles);
  EXPECT_TRUE(p.receiver);
  ASSERT_EQ(p.occluders.size(), 1u);
  const Occluder& o = p.occluders[0];
  EXPECT_EQ(o.triangle, 0u);
  EXPECT_EQ(o.bits, bits_left_of(s, 0.1f));
  EXPECT_EQ(p.hidden, o.bits);
  EXPECT_NE(o.bits, 0u);
  EXPECT_NE(o.bits, ~0u);
  EXPECT_EQ(p.counts, (std::array<uint32_t, 2>{1, 1}));
  // Edge ab is x = 1.6: 0.1 - o.x, up to a scale.
  const glm::dvec3 line = o.lines[0] / -o.lines[0].y;
  EXPECT_NEAR(line.x, 0.1, 1e-6);
  EXPECT_NEAR(line.z, 0.0, 1e-9);
  EXPECT_GT(o.lines[0].x, 0.0);
  // It lies 5 m above the whole pixel, less the bias.
  const glm::dvec3 a(triangles[0]), b(triangles[1]), c(triangles[2]);
  const glm::vec2 bias = shared::quad_bias(s.camera, glm::vec3(1.5f, 1.5f, -10.0f), 10.0f,
                                           shared::max_norm1(triangles[0], triangles[1], triangles[2]),
                                           shared::doubt_of(s.camera, s.gbuffer.micro_quad[0]));
  EXPECT_NEAR(o.lines[3].x / glm::length(glm::cross(b - a, c - a)), 5.0 - double(bias.y), 1e-9);
  EXPECT_GT(bias.y, 1e-6f);
  EXPECT_EQ(o.lines[3].y, 0.0);
}

TEST(ViewProbe, CountsWhoHidesAndWhoAloneDecides) {
  const Snapshot s = floor_from_above(4, 3);
  Triangles triangles;
  add_left_of(triangles, 1.4f, -5.0f);
  add_left_of(triangles, 1.7f, -4.0f);  // hides more, and all that the others hide
  add_left_of(triangles, 1.4f, -3.0f);
  add_left_of(triangles, 0.5f, -3.0f);  // beside the pixel
  const ProbedPixel p = probed(s, triangles);
  EXPECT_EQ(p.counts, (std::array<uint32_t, 2>{3, 1}));
  ASSERT_EQ(p.occluders.size(), 3u);
  EXPECT_EQ(p.occluders[0].triangle, 1u);
  EXPECT_EQ(p.occluders[1].triangle, 0u);
  EXPECT_EQ(p.hidden, bits_left_of(s, 0.2f));
}

TEST(ViewProbe, ListsNoMoreThanItSaysAndCountsAll) {
  const Snapshot s = floor_from_above(4, 3);
  Triangles triangles;
  for (int i = 0; i < 100; ++i) add_left_of(triangles, 1.5f, -5.0f + 0.01f * float(i));
  const ProbedPixel p = probed(s, triangles);
  EXPECT_EQ(p.occluders.size(), most_occluders);
  EXPECT_EQ(p.counts, (std::array<uint32_t, 2>{100, 0}));
}

TEST(ViewProbe, ThePixelsOwnTriangleIsNotAsked) {
  Snapshot s = floor_from_above(4, 3);
  Triangles triangles;
  add_left_of(triangles, 50.0f, -20.0f);
  add_left_of(triangles, 50.0f, -5.0f);
  EXPECT_EQ(probed(s, triangles).hidden, ~0u);
  s.gbuffer.id.assign(s.size(), glm::uvec2(2, 1));
  s.first_triangle = {7, 0};
  EXPECT_EQ(probed(s, triangles).hidden, 0u);
}

TEST(ViewProbe, TheMicroQuadStandsOnTheTangentPlane) {
  Snapshot s = floor_from_above(4, 3);
  ProbedPixel p = probed(s, {});
  EXPECT_EQ(p.micro_quad_tangent[0], glm::dvec2(-0.5, -0.5));
  EXPECT_EQ(p.micro_quad_tangent[2], glm::dvec2(0.5, 0.5));
  ASSERT_EQ(p.samples_tangent.size(), 32u);
  for (size_t n = 0; n < 32; ++n) EXPECT_EQ(p.samples_tangent[n], glm::dvec2(s.samples.offsets_px[n]));
  // Turned about y by 60 degrees it is twice as long along x; its distance changes by sqrt(3) m a pixel.
  const float steep = std::sqrt(3.0f);
  s.gbuffer.normal.assign(s.size(), shared::octahedral_encode(glm::vec3(0.5f * steep, 0, 0.5f)));
  s.gbuffer.micro_quad.assign(s.size(), glm::vec4(10, steep, 0, 1));
  p = probed(s, {});
  EXPECT_NEAR(p.micro_quad_tangent[0].x, -1.0, 1e-6);
  EXPECT_NEAR(p.micro_quad_tangent[0].y, -0.5, 1e-6);
  EXPECT_NEAR(p.micro_quad_tangent[1].x, 1.0, 1e-6);
}

TEST(ViewProbe, AtOneSampleTheCentreDecides) {
  Snapshot s = floor_from_above(4, 3);
  s.samples = center_sample();
  s.gbuffer.micro_quad.clear();
  Triangles triangles;
  add_left_of(triangles, 1.6f, -5.0f);
  add_left_of(triangles, 1.4f, -5.0f);
  const ProbedPixel p = probed(s, triangles);
  EXPECT_EQ(p.hidden, ~0u);
  ASSERT_EQ(p.occluders.size(), 1u);
  EXPECT_EQ(p.occluders[0].triangle, 0u);
  EXPECT_EQ(p.occluders[0].bits, ~0u);
  EXPECT_NEAR(p.occluders[0].lines[0].x / -p.occluders[0].lines[0].y, 0.1, 1e-6);
}

TEST(ViewProbe, WhoAsksForNoShadowHasNoOccluders) {
  Snapshot s = floor_from_above(4, 3);
  s.gbuffer.eye_distance[s.index({1, 1})] = 0.0f;
  s.mask.assign(s.size(), 7u);
  Triangles triangles;
  add_left_of(triangles, 1.6f, -5.0f);
  const ProbedPixel p = probed(s, triangles);
  EXPECT_FALSE(p.receiver);
  EXPECT_TRUE(p.occluders.empty());
  EXPECT_EQ(p.mask, 7u);
}

/// By all triangles, without what probe() skips.
uint32_t hidden_by_all(const Snapshot& s, const Triangles& triangles, const glm::ivec2& px) {
  const size_t i = s.index(px);
  uint32_t hidden = 0;
  for (size_t k = 0; k < triangles.size(); k += 3) {
    const shared::QuadPlanes planes =
        shared::quad_planes(s.camera, s.light, triangles[k], triangles[k + 1], triangles[k + 2],
                            glm::ivec2(s.gbuffer.center_px(i)), s.gbuffer.micro_quad[i]);
    for (size_t n = 0; n < 32; ++n)
      if (shared::occluded_sample(planes, s.samples.offsets_px[n])) hidden |= 1u << n;
  }
  return hidden;
}

TEST(ViewProbe, WhatItSkipsHidesNothing) {
  Snapshot s = floor_from_above(4, 3);
  Random random(12);
  int partly = 0;
  for (int round = 0; round < 400; ++round) {
    // From a sun, a lamp far away, and one so near that micro-quads reach around it.
    const glm::dvec3 lamp(random.uniform(0, 4), random.uniform(0, 3), round % 3 == 1 ? -2.0 : -9.9);
    s.light = make_light(random.direction() - glm::dvec3(0, 0, 1.5), round % 3 == 0 ? nullptr : &lamp);
    s.light.grid = glm::uvec4(16, 1, 1, 0);
    s.light.to_light.w = round % 3 == 0 ? 0.0f : -1.0f;
    Triangles triangles;
    for (int k = 0; k < 30; ++k) {
      const glm::dvec3 at = glm::dvec3(2, 1.5, -8) + random.point(3.0);
      for (int v = 0; v < 3; ++v) triangles.emplace_back(at + random.point(k % 3 == 0 ? 2.0 : 0.3));
    }
    for (int y = 0; y < 3; ++y)
      for (int x = 0; x < 4; ++x) {
        const uint32_t all = hidden_by_all(s, triangles, {x, y});
        EXPECT_EQ(probe(s, triangles, {x, y}).hidden, all) << round;
        partly += all != 0 && all != ~0u;
      }
  }
  EXPECT_GT(partly, 1000);
}

TEST(ViewProbe, TellsInWhichTexelsThePixelStands) {
  Snapshot s = floor_from_above(4, 3);
  s.built = IzbInternals{};
  s.built->grid = 2;
  s.built->layers = 1;
  s.built->lists.first = {0, 0, 1, 1, 1};
  s.built->lists.nodes = {shared::node_from_pixel({1, 1}, 3)};
  const auto texels = probed(s, {}).texels;
  ASSERT_EQ(texels.size(), 1u);
  EXPECT_EQ(texels[0].second, glm::ivec2(1, 0));
}

// Well under the time of a frame of the interface, also on a slow core: measured 10 to 20 ms.
TEST(ViewProbe, ALargeSceneTakesMilliseconds) {
  const Snapshot s = floor_from_above(4, 3);
  Random random(13);
  Triangles triangles;
  for (int k = 0; k < 300000; ++k) {
    const glm::dvec3 at = glm::dvec3(2, 1.5, -8) + random.point(100.0);
    for (int v = 0; v < 3; ++v) triangles.emplace_back(at + random.point(0.5));
  }
  const auto start = std::chrono::steady_clock::now();
  const ProbedPixel p = probed(s, triangles);
  const std::chrono::duration<double, std::milli> elapsed = std::chrono::steady_clock::now() - start;
  RecordProperty("ms", std::to_string(elapsed.count()));
  std::printf("%.1f ms, %u occluders\n", elapsed.count(), p.counts[0]);
#ifdef NDEBUG
  EXPECT_LT(elapsed.count(), 1000.0);  // the machine may be busy
#endif
}

}  // namespace
}  // namespace izb::test
