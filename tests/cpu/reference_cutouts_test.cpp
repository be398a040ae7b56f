// SPDX-License-Identifier: MIT
// Alpha masks of the ground truth.
#include "reference/cutouts.h"

#include <gtest/gtest.h>

#include "reference/embree.h"
#include "reference/exact.h"
#include "reference/settle.h"
#include "reference_fixture.h"

namespace izb::reference {
namespace {

Texture texture_of(int width, int height, const std::vector<uint8_t>& alpha) {
  Texture t;
  t.width_px = width, t.height_px = height;
  for (const uint8_t a : alpha) t.rgba.insert(t.rgba.end(), {0, 0, 0, a});
  return t;
}

Scene scene_of(const Texture& texture) {
  Scene scene;
  scene.textures.push_back(texture);
  scene.materials.emplace_back();
  scene.materials[0].alpha_mode = AlphaMode::mask;
  scene.materials[0].base_color_texture = 0;
  return scene;
}

/// A triangle at height 2 on which u = x and v = z.
const Corners above{{0, 2, 0}, {8, 2, 0}, {0, 2, 8}};
const glm::vec2 uvs[3] = {{0, 0}, {8, 0}, {0, 8}};
const glm::dvec3 up(0, 1, 0);

Presence at(const Scene& scene, double x, double z, double reach) {
  Cutouts cutouts(scene);
  cutouts.add_opaque(1);
  cutouts.add(0, uvs);
  EXPECT_TRUE(cutouts.within(0, above, {{x, 0, z}, up, reach}).there);
  const Presence presence = cutouts.within(1, above, {{x, 0, z}, up, reach});
  EXPECT_EQ(presence.there, cutouts.there(1, above, {x, 0, z}, up));
  return presence;
}

TEST(Cutouts, NearestTexelsEndAtTheirBordersWithinTheReach) {
  Texture texture = texture_of(2, 1, {255, 0});  // there for u in [0, 1/2), and so on
  texture.nearest = true;
  const Scene scene = scene_of(texture);
  for (int period = 0; period < 3; ++period) {
    EXPECT_TRUE(at(scene, period + 0.25, 0.3, 0.2).there);
    EXPECT_FALSE(at(scene, period + 0.75, 0.3, 0.2).there);
    EXPECT_TRUE(at(scene, period + 0.25, 0.3, 0.2).sure);
    EXPECT_FALSE(at(scene, period + 0.25, 0.3, 0.26).sure);
    EXPECT_FALSE(at(scene, period + 0.51, 0.3, 0.02).sure);
  }
}

TEST(Cutouts, MirroredAndClampedTexelsGoOnAsTheyShould) {
  Texture texture = texture_of(2, 1, {255, 0});
  texture.nearest = true;
  texture.wrap_u = Wrap::mirrored_repeat;
  EXPECT_FALSE(at(scene_of(texture), 1.25, 0.3, 0.0).there);
  EXPECT_TRUE(at(scene_of(texture), 1.75, 0.3, 0.0).there);
  EXPECT_TRUE(at(scene_of(texture), -0.25, 0.3, 0.0).there);
  texture.wrap_u = Wrap::clamp_to_edge;
  EXPECT_FALSE(at(scene_of(texture), 5.25, 0.3, 0.0).there);
  EXPECT_TRUE(at(scene_of(texture), -3.0, 0.3, 0.0).there);
}

TEST(Cutouts, BetweenTexelsAlphaIsLinearAndItsChangeBoundsWhatIsSure) {
  Texture texture = texture_of(2, 1, {255, 0});
  texture.wrap_u = Wrap::clamp_to_edge;
  Scene scene = scene_of(texture);
  // From 1 at u = 1/4 to 0 at u = 3/4: a half at 1/2.
  EXPECT_TRUE(at(scene, 0.49, 0.3, 0.005).there);
  EXPECT_TRUE(at(scene, 0.49, 0.3, 0.005).sure);
  EXPECT_FALSE(at(scene, 0.49, 0.3, 0.011).sure);
  EXPECT_FALSE(at(scene, 0.51, 0.3, 0.005).there);
  EXPECT_TRUE(at(scene, 0.51, 0.3, 0.005).sure);
  scene.materials[0].alpha_cutoff = 0.9f;  // reached at 1/4 + 1/20
  EXPECT_TRUE(at(scene, 0.29, 0.3, 0.0).there);
  EXPECT_FALSE(at(scene, 0.31, 0.3, 0.0).there);
  scene.materials[0].base_color.a = 0.91f;
  EXPECT_FALSE(at(scene, 0.29, 0.3, 0.0).there);
}

TEST(Cutouts, OfACutoffThatEveryOrNoAlphaPassesAllIsSure) {
  Scene scene = scene_of(texture_of(2, 2, {0, 255, 255, 0}));
  scene.materials[0].alpha_cutoff = 0.0f;
  EXPECT_TRUE(at(scene, 0.4, 0.6, 5.0).there);
  EXPECT_TRUE(at(scene, 0.4, 0.6, 5.0).sure);
  scene.materials[0].alpha_cutoff = 1.5f;
  EXPECT_FALSE(at(scene, 0.4, 0.6, 5.0).there);
  EXPECT_TRUE(at(scene, 0.4, 0.6, 5.0).sure);
  Scene full = scene_of(texture_of(1, 1, {255}));
  full.materials[0].alpha_cutoff = 1.0f;
  EXPECT_TRUE(at(full, 0.4, 0.6, 5.0).there);
  EXPECT_TRUE(at(full, 0.4, 0.6, 5.0).sure);
  full.materials[0].base_color_texture = -1;
  EXPECT_TRUE(at(full, 0.4, 0.6, 5.0).there);
  full.materials[0].base_color.a = 0.99f;
  EXPECT_FALSE(at(full, 0.4, 0.6, 5.0).there);
}

TEST(Cutouts, TheTransformOfTextureCoordinatesCounts) {
  Texture texture = texture_of(2, 1, {255, 0});
  texture.nearest = true;
  Scene scene = scene_of(texture);
  scene.materials[0].uv_transform = glm::mat3(0, 0, 0, 0.5f, 0, 0, 0.5f, 0, 1);  // u = v / 2 + 1 / 2
  EXPECT_FALSE(at(scene, 0.2, 0.5, 0.0).there);
  EXPECT_TRUE(at(scene, 0.2, 1.5, 0.0).there);
}

// What is sure is so for every line within the reach, however the triangle stands.
TEST(Cutouts, SureIsSureForEveryLineWithinReach) {
  Random random(5);
  size_t sure = 0, unsure = 0;
  for (int i = 0; i < 3000; ++i) {
    std::vector<uint8_t> alpha(35);
    for (uint8_t& a : alpha) a = random.uniform(0, 1) < 0.5 ? 0 : uint8_t(random.uniform(0, 255));
    Texture texture = texture_of(5, 7, alpha);
    texture.nearest = i % 3 == 0;
    texture.wrap_u = static_cast<Wrap>(i % 2), texture.wrap_v = static_cast<Wrap>(i % 3);
    Cutouts cutouts(scene_of(texture));
    const glm::vec2 uv[3] = {glm::vec2(random.point(-1, 2)), glm::vec2(random.point(-1, 2)),
                             glm::vec2(random.point(-1, 2))};
    cutouts.add(0, uv);
    const Corners t{random.point(-1, 1), random.point(-1, 1), random.point(-1, 1)};
    const glm::dvec3 hit = (glm::dvec3(t.a) + glm::dvec3(t.b) + glm::dvec3(t.c)) / 3.0;
    const glm::dvec3 light(random.point(4, 8)), p = hit + (hit - light) * random.uniform(0.1, 1.0);
    const double reach = 3e-3;
    const Presence presence = cutouts.within(0, t, {p, light - p, reach, reach});
    presence.sure ? ++sure : ++unsure;
    if (!presence.sure) continue;
    for (int k = 0; k < 30; ++k) {
      const glm::dvec3 move = glm::normalize(glm::dvec3(random.point(-1, 1))) * (reach * random.uniform(0.5, 0.999));
      EXPECT_EQ(cutouts.there(0, t, p + move, light - p - move), presence.there) << i;
      EXPECT_EQ(cutouts.there(0, t, p + move, light - p), presence.there) << i;
    }
  }
  EXPECT_GT(sure, 1000u);
  EXPECT_GT(unsure, 100u);
}

// A floor point under a hole is lit for rays, for the exact mask and for the settling; under a solid texel it is not.
TEST(Cutouts, RaysAndTheExactMaskPassThroughHoles) {
  if (!embree_available()) GTEST_SKIP() << "this build has no Embree";
  Texture texture = texture_of(2, 1, {255, 0});
  texture.nearest = true;
  auto cutouts = std::make_shared<Cutouts>(scene_of(texture));
  cutouts->add(0, uvs);
  Triangles triangles;
  add_triangle(triangles, above.a, above.b, above.c);
  triangles.cutouts = cutouts;
  Receivers receivers;
  for (const float x : {0.25f, 0.75f, 1.25f, 1.75f}) add_receiver(receivers, {x, 0, 0.5f});
  const LightPoint sun{{0, 1, 0}, false};
  const std::vector<uint32_t> expected{dark, 0, dark, 0};
  EXPECT_EQ(exact_mask(triangles, sun, receivers), expected);
  const RayTracer tracer(triangles);
  EXPECT_EQ(tracer.trace_mask(sun, receivers).mask, expected);
  EXPECT_EQ(settle(triangles, sun, receivers, expected, expected).disputed, 0u);
  // Each wrong bit is unexplained: no edge and no texel's border is near.
  const Settled wrong = settle(triangles, sun, receivers, std::vector<uint32_t>{0, dark, 0, dark}, expected);
  EXPECT_EQ(wrong.unexplained, 4u);
  EXPECT_EQ(wrong.leaks, 2u);
  EXPECT_EQ(wrong.false_shadow, 2u);
  EXPECT_EQ(
      tracer.primary_hits(std::vector<glm::vec3>{{0.75f, 0, 0.5f}}, std::vector<glm::vec3>{{0, 1, 0}}).triangle[0],
      no_triangle);
  EXPECT_EQ(
      tracer.primary_hits(std::vector<glm::vec3>{{0.25f, 0, 0.5f}}, std::vector<glm::vec3>{{0, 1, 0}}).triangle[0], 0u);
}

// The only sample of a pixel is a point of floats: it has no error that could explain anything. Of 32 each has its own,
// far below the band.
TEST(Cutouts, OnlyASamplesOwnErrorExplainsABitAtACutoff) {
  Texture texture = texture_of(2, 1, {255, 0});
  texture.nearest = true;
  auto cutouts = std::make_shared<Cutouts>(scene_of(texture));
  cutouts->add(0, uvs);
  cutouts->add_opaque(1);
  Triangles triangles;
  add_triangle(triangles, {0, 2, -9}, {8, 2, -9}, {0, 2, -1});
  add_triangle(triangles, {-9, 5, -10.5f}, {9, 5, -10.5f}, {0, -5, -0.5f});  // the receivers' own
  triangles.cutouts = cutouts;
  const LightPoint sun{{0, 1, 0}, false};
  const auto all_wrong = [&](float x, bool many) {
    Receivers receivers;
    add_receiver(receivers, {x, 0, -5.5f}, 1e-2f, 1);
    if (many) {
      receivers.offsets_px.assign(32, glm::dvec2(0.0));
      receivers.camera = {glm::dvec2(1e-3), false};
      receivers.slopes.assign(1, glm::dvec2(0.25));
    }
    const std::vector<uint32_t> truth{x < 0.5f ? dark : 0u}, mask{~truth[0]};
    return settle(triangles, sun, receivers, mask, truth);
  };
  for (const float x : {0.4999f, 0.5001f}) EXPECT_EQ(all_wrong(x, false).unexplained, 1u) << x;
  for (const float x : {0.499f, 0.501f}) EXPECT_EQ(all_wrong(x, true).unexplained, 32u) << x;
  for (const float x : {0.49999997f, 0.50000006f}) {
    const Settled close = all_wrong(x, true);
    EXPECT_EQ(close.explained_by_alpha, 32u) << x;
    EXPECT_EQ(close.verdicts[0], Verdict::explained_by_alpha) << x;
    EXPECT_EQ(all_wrong(x, false).unexplained, 1u) << x;
  }
}

}  // namespace
}  // namespace izb::reference
