// SPDX-License-Identifier: MIT
// The occlusion prepass spares receivers in full shadow their nodes and changes no bit of an exact mask.
#include "gl/frame_fixture.h"
#include "gl/masked_scene.h"

namespace izb::test {
namespace {

constexpr int width_px = 96, height_px = 64;
const Camera camera = look_at({4.0, 5.0, 7.0}, {0, 0.6, 0}, glm::radians(50.0));
const Settings one{{"grid", "128"}};
const Settings exact{{"spp", "32"}, {"coverage", "exact"}, {"insertion", "exact"}, {"grid", "128"}};

/// Large triangles, walls on the floor and small ones.
Scene occluding_scene(uint32_t seed) {
  Scene scene = tangle(seed, 150);
  add_soup(scene, rectangle({-3.0f, 0.0f, -1.0f}, {0.0f, 2.5f, 0.0f}, {4.0f, 0.0f, 0.5f}));
  add_soup(scene, rectangle({1.0f, 1.8f, 0.0f}, {0.0f, 0.3f, 2.5f}, {2.5f, 0.2f, 0.0f}));
  return scene;
}

struct Case {
  const char* name;
  Light light;
};

std::vector<Case> cases() {
  return {{"sun", sun(130, 35)},
          {"low sun", sun(40, 9)},
          {"spot", spot({2.0, 6.0, 3.0}, {0, 0, 0}, 40)},
          {"lamp", point_light({0.4, 3.3, 0.7})}};
}

Settings prepass(const Settings& settings) {
  return with(settings, {{"occluders", "on"}});
}

Settings without(const Settings& settings) {
  return with(settings, {{"occluders", "off"}});
}

/// Pixels of full shadow that have no node.
size_t hidden(const Frame& frame) {
  size_t n = 0;
  for (size_t i = 0; i < frame.mask.size(); ++i) n += frame.mask[i] == 0xffffffffu && frame.list_lengths[i] == 0.0f;
  return n;
}

TEST(Occluders, HideNothingWhereTheyAreOff) {
  const Frame frame = render_frame(occluding_scene(200), camera, sun(130, 35), width_px, height_px, without(one));
  EXPECT_EQ(hidden(frame), 0u);
}

void expect_brute_force_masks(const Scene& scene, const Settings& settings) {
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    const Frame frame = render_frame(scene, camera, c.light, width_px, height_px, prepass(settings));
    const bool many = frame.receivers.sample_count() == 32;
    EXPECT_EQ(different(frame.mask, many ? brute_force_words(frame) : brute_force_mask(frame)), 0u);
    EXPECT_GT(hidden(frame), 100u);
    expect_explained(frame);
  }
}

TEST(Occluders, LeaveTheBruteForceMaskAtOneSample) {
  expect_brute_force_masks(occluding_scene(200), one);
}

TEST(Occluders, LeaveTheBruteForceMaskAt32Samples) {
  expect_brute_force_masks(occluding_scene(201), exact);
}

TEST(Occluders, SpareNodesAndTests) {
  const Scene scene = occluding_scene(202);
  for (const Settings& settings : {one, exact, Settings{{"spp", "32"}, {"grid", "128"}}}) {
    const Frame all = render_frame(scene, camera, sun(130, 35), width_px, height_px, without(settings));
    const Frame frame = render_frame(scene, camera, sun(130, 35), width_px, height_px, prepass(settings));
    EXPECT_LT(frame.count("nodes"), all.count("nodes"));
    EXPECT_LT(frame.count("visibility_tests"), all.count("visibility_tests"));
    EXPECT_LE(frame.count("fragments_after_zcull"), all.count("fragments_after_zcull"));
  }
}

TEST(Occluders, TheExactMaskIsThatWithoutThemByEveryOption) {
  const Scene scene = occluding_scene(203);
  for (const Case& c : {cases()[0], cases()[3]}) {
    const bool lamp = c.light.type == LightType::point;
    const Frame base = render_frame(scene, camera, c.light, width_px, height_px, without(exact));
    for (const Settings& variant :
         {Settings{{"removal", "off"}}, Settings{{"zcull", "off"}}, Settings{{"zcull-pyramid", "off"}, {"grid", "64"}},
          Settings{{"cascades", "3"}}, Settings{{"cascades", "3"}, {"cascade-pass", "multiple"}, {"removal", "off"}},
          Settings{{"raster", "compute"}}, Settings{{"pairs", "0"}}}) {
      if (lamp && variant[0].first != "cascades") continue;  // six grids each: compiling takes its time
      const Frame frame = render_frame(scene, camera, c.light, width_px, height_px, with(prepass(exact), variant));
      EXPECT_EQ(different(base.mask, frame.mask), 0u) << c.name << " " << variant[0].first;
      EXPECT_GT(hidden(frame), 30u) << c.name << " " << variant[0].first;
    }
  }
}

TEST(Occluders, WithAlphaMasksHideNothing) {
  Scene scene = masked_tangle(204);
  add_soup(scene, rectangle({-3.0f, 0.0f, -1.0f}, {0.0f, 2.5f, 0.0f}, {4.0f, 0.0f, 0.5f}));
  const Frame opaque =
      render_frame(scene, camera, sun(130, 35), width_px, height_px, prepass(with(one, {{"alpha", "off"}})));
  EXPECT_EQ(
      different(
          opaque.mask,
          render_frame(scene, camera, sun(130, 35), width_px, height_px, without(with(one, {{"alpha", "off"}}))).mask),
      0u);
  const Frame frame = render_frame(scene, camera, sun(130, 35), width_px, height_px, prepass(one));
  EXPECT_EQ(different(frame.mask, brute_force_mask(frame)), 0u);
  EXPECT_GT(hidden(frame), 50u);
  EXPECT_LT(hidden(frame), hidden(opaque));
}

// A stack of sheets over the floor, closer and closer, down to what rounding cannot tell from the floor.
TEST(Occluders, AsNearAsTheyMayBeAreWhatTheTestSays) {
  Scene scene = empty_scene();
  add_soup(scene, floor_of(12.0f));
  float height = 1.0f;
  for (int i = 0; i < 24; ++i, height *= 0.5f)
    add_soup(scene, rectangle({-3.0f + 0.25f * float(i), height, -2.0f}, {0, 0, 4}, {0.25f, 0, 0}));
  const Camera above = look_at({1.0, 6.0, 4.0}, {0, 0, 0}, glm::radians(50.0));
  for (const Settings& settings : {one, exact}) {
    const Frame frame = render_frame(scene, above, sun(0, 75), width_px, height_px, prepass(settings));
    const Frame all = render_frame(scene, above, sun(0, 75), width_px, height_px, without(settings));
    EXPECT_EQ(different(frame.mask, all.mask), 0u);
    expect_explained(frame);
  }
}

TEST(Occluders, AnotherFrameByTheSameRendererHasItsOwn) {
  const Scene scene = occluding_scene(205);
  const std::unique_ptr<Technique> technique = make_technique("izb");
  set_options(*technique, prepass(exact));
  Renderer renderer(scene, capabilities());
  renderer.prepare(*technique, width_px, height_px, {sun(130, 35)});
  const Frame first = render_frame(renderer, *technique, camera, sun(130, 35));
  const Frame second = render_frame(renderer, *technique, camera, sun(310, 30));
  EXPECT_EQ(different(second.mask, brute_force_words(second)), 0u);
  EXPECT_GT(different(first.mask, second.mask), 100u);
}

}  // namespace
}  // namespace izb::test
