// SPDX-License-Identifier: MIT
// Micro-quads lifted out of concave surfaces.
#include <bit>
#include <numeric>

#include "gl/frame_fixture.h"
#include "shared/lift.h"

namespace izb::test {
namespace {

constexpr int width_px = 96, height_px = 72;
const Camera camera = look_at({4.0, 5.0, 7.0}, {0, 0.0, 0}, glm::radians(50.0));
const Light noon = sun(130, 80);
const Settings exact{{"spp", "32"}, {"coverage", "exact"}, {"insertion", "exact"}};
const Settings tangent = with(exact, {{"micro-quad", "tangent"}}), lifted = with(exact, {{"micro-quad", "lifted"}});

size_t bits(const std::vector<uint32_t>& mask) {
  return std::accumulate(mask.begin(), mask.end(), size_t{0},
                         [](size_t sum, uint32_t word) { return sum + size_t(std::popcount(word)); });
}

/// A floor in folds of that width and height, finely cut along them.
Scene folds(float fold, float height) {
  Scene scene = empty_scene();
  std::vector<glm::vec3> all;
  for (float x = -3.0f; x < 3.0f; x += fold)
    for (int half = 0; half < 2; ++half) {
      const float from = x + 0.5f * fold * float(half), to = from + 0.5f * fold;
      const float low = half == 0 ? 0.0f : height, high = half == 0 ? height : 0.0f;
      const auto part = rectangle({from, low, -3.0f}, {0, 0, 6.0f}, {to - from, high - low, 0});
      all.insert(all.end(), part.begin(), part.end());
    }
  add_soup(scene, all);
  return scene;
}

uint64_t lifted_pixels(const Frame& frame) {
  uint64_t n = 0;
  for (size_t i = 0; i < frame.mask.size(); ++i) n += frame.gbuffer.micro_quad[i].x != frame.gbuffer.eye_distance[i];
  return n;
}

TEST(Lift, ASunHighOverFoldsMakesNoShadow) {
  // No fold hides the sun from another: all shadow is the micro-quads' own, below the surface. Where the floor
  // ends no neighbour tells that it rises; the second's folds are about two pixels wide, and a neighbour may see the
  // next.
  for (const float fold : {1.0f, 0.25f}) {
    const Scene scene = folds(fold, 0.12f * fold);
    const Frame before = render_frame(scene, camera, noon, width_px, height_px, tangent);
    const Frame after = render_frame(scene, camera, noon, width_px, height_px, lifted);
    EXPECT_EQ(lifted_pixels(before), 0u);
    EXPECT_GT(lifted_pixels(after), 100u);
    EXPECT_GT(bits(before.mask), 500u) << fold;
    EXPECT_LT(bits(after.mask), bits(before.mask) / (fold == 1.0f ? 50 : 5)) << fold;
    expect_explained(before);
    expect_explained(after);
  }
}

/// The lifted eye distance of pixel i, by the shaders' own text.
float lifted_by_text(const Frame& frame, size_t i) {
  const shared::CameraFrame& eye = frame.inputs.camera;
  const float t = frame.gbuffer.eye_distance[i];
  const glm::vec3 p = receiver_point_vs(frame.gbuffer, eye, i),
                  normal = shared::octahedral_decode(frame.gbuffer.normal[i]);
  float rise = 0.0f;
  for (int y = -1; y <= 1; ++y)
    for (int x = -1; x <= 1; ++x) {
      const glm::ivec2 q = glm::ivec2(int(i) % width_px, int(i) / width_px) + glm::ivec2(x, y);
      if (q.x < 0 || q.y < 0 || q.x >= width_px || q.y >= height_px) continue;
      const size_t k = size_t(q.y * width_px + q.x);
      if (k == i || !(frame.gbuffer.eye_distance[k] > 0.0f)) continue;
      const glm::vec3 way = receiver_point_vs(frame.gbuffer, eye, k) - p;
      const float its = glm::dot(normal, way);
      if (shared::is_rise(its, p, shared::pixel_width(eye, t)) &&
          shared::bends_up(way, its, normal, shared::octahedral_decode(frame.gbuffer.normal[k])))
        rise = std::max(rise, its);
    }
  return rise > 0.0f ? shared::lifted_distance(eye, p, normal, t, rise) : t;
}

TEST(Lift, TheGBuffersLiftIsTheSharedTexts) {
  Scene scene = folds(0.3f, 0.08f);
  add_soup(scene, tangle(87, 200).meshes[1].positions);
  Camera flat = camera;
  flat.orthographic = true;
  flat.ymag = 3.0;
  flat.near_plane = 0.1;
  flat.far_plane = 40.0;
  for (const Camera& eye : {camera, flat}) {
    const Frame frame = render_frame(scene, eye, noon, width_px, height_px, lifted);
    size_t other = 0;
    for (size_t i = 0; i < frame.mask.size(); ++i)
      if (frame.gbuffer.eye_distance[i] > 0.0f)
        other +=
            std::abs(frame.gbuffer.micro_quad[i].x - lifted_by_text(frame, i)) > 1e-6f * frame.gbuffer.eye_distance[i];
    // Dot products that a driver fuses may fall on the other side of a limit.
    EXPECT_LE(other, 2u);
    EXPECT_GT(lifted_pixels(frame), 500u);
  }
}

TEST(Lift, TheMaskIsThatOfRaysFromTheLiftedPoints) {
  Scene scene = folds(0.2f, 0.03f);
  add_soup(scene, rectangle({-2, 0.4f, -2}, {0, 0.8f, 4}, {0.6f, 0.1f, 0}));
  for (const Light& light : {sun(40, 12), spot({2.0, 4.0, 3.0}, {0, 0, 0}, 40)}) {
    const Frame frame = render_frame(scene, camera, light, width_px, height_px, lifted);
    EXPECT_EQ(different(frame.mask, brute_force_words(frame)), 0u);
    EXPECT_GT(lifted_pixels(frame), 500u);
    expect_explained(frame);
  }
}

TEST(Lift, WhatFacesAwayIsInTheShadowOfItsOwnTriangle) {
  const Scene scene = folds(0.2f, 0.03f);
  for (const char* raster : {"gs", "compute"}) {
    const Settings settings = with(lifted, {{"nl-cull", "off"}, {"raster", raster}});
    const Frame frame = render_frame(scene, camera, sun(130, -60), width_px, height_px, settings);
    EXPECT_GT(lifted_pixels(frame), 500u);
    EXPECT_EQ(different(frame.mask, brute_force_words(frame)), 0u) << raster;
    expect_explained(frame);
    Frame by_table =
        render_frame(scene, camera, sun(130, -60), width_px, height_px, with(settings, {{"coverage", "lut"}}));
    for (size_t i = 0; i < frame.mask.size(); ++i) by_table.mask[i] ^= frame.mask[i];
    EXPECT_LT(bits(by_table.mask), bits(frame.mask) / 100) << "all but what the table quantises";
  }
}

TEST(Lift, FlatFloorsAndRoofsStayWhereTheyAre) {
  Scene flat = empty_scene();
  add_soup(flat, floor_of(10.0f, 60), glm::rotate(glm::dmat4(1.0), 0.3, glm::dvec3(1.0, 2.0, 0.5)));
  Scene roof = empty_scene();
  add_soup(roof, rectangle({-3, 0, -3}, {0, 0, 6}, {3, 0.7f, 0}));
  add_soup(roof, rectangle({0, 0.7f, -3}, {0, 0, 6}, {3, -0.7f, 0}));
  for (const Scene* scene : {&flat, &roof})
    EXPECT_EQ(lifted_pixels(render_frame(*scene, camera, noon, width_px, height_px, lifted)), 0u);
}

TEST(Lift, ThePaperHasNone) {
  const auto technique = make_technique("izb");
  technique->apply_preset("paper");
  EXPECT_FALSE(technique->samples().lifted);
  EXPECT_TRUE(make_technique("izb")->samples().lifted);
  EXPECT_TRUE(make_technique("ray_traced")->samples().lifted) << "or rays would start elsewhere";
}

}  // namespace
}  // namespace izb::test
