// SPDX-License-Identifier: MIT
// Lights in every place and direction, each mask against all pairs and against rays: inside the scene, on a surface, at
// a vertex, at the camera and behind it; suns at the horizon, overhead and along the view.
#include "gl/frame_fixture.h"

namespace izb::test {
namespace {

constexpr int width_px = 96, height_px = 64;
const glm::dvec3 eye(4.0, 3.0, 6.0), target(0.0, 0.8, 0.0);
const Camera camera = look_at(eye, target, glm::radians(50.0));

struct Case {
  const char* name;
  Light light;
  bool casts = true;  ///< some shadow can be seen
};

Scene scene_of_cases() {
  return tangle(140, 220);
}

std::vector<Case> cube_cases(const Scene& scene) {
  const glm::dvec3 vertex(scene.meshes[1].positions[4]);
  return {{"amid the triangles", point_light({0.4, 1.3, 0.7})},
          {"on the floor", point_light({1.3, 0.0, 1.1})},
          {"a hair above the floor", point_light({1.3, 1e-4, 1.1})},
          {"at a vertex", point_light(vertex)},
          {"near a vertex", point_light(vertex + glm::dvec3(1e-5, 2e-5, -1e-5))},
          {"below the floor", point_light({0.3, -2.0, 0.2})},
          {"at the camera", point_light(eye), false},
          {"behind the camera", point_light(eye + 0.7 * (eye - target) + glm::dvec3(0.5, 1.0, 0.0))},
          {"far away", point_light({3000.0, 5000.0, 2000.0})},
          {"a spot of 75 degrees", spot({0.8, 2.2, 0.5}, {0, 0, 0}, 75)},
          {"a spot of 90 degrees on the floor", spot({1.0, 0.0, 1.5}, {1.0, 1.0, 1.5}, 90)}};
}

std::vector<Case> sun_cases() {
  Light along = sun(0, 0);
  along.direction_ws = glm::normalize(target - eye);
  Light against = along;
  against.direction_ws = -along.direction_ws;
  return {{"at half a degree", sun(250, 0.5)},
          {"overhead", sun(0, 90)},
          {"along the view", along, false},
          {"against the view", against}};
}

void check(const std::vector<Case>& cases, const Scene& scene, const Settings& settings) {
  const std::unique_ptr<Technique> technique = make_technique("izb");
  set_options(*technique, settings);
  Renderer renderer(scene, capabilities());
  renderer.prepare(*technique, width_px, height_px, {cases.front().light});
  for (const Case& c : cases) {
    SCOPED_TRACE(c.name);
    const Frame frame = render_frame(renderer, *technique, camera, c.light);
    const bool many = frame.receivers.sample_count() == 32;
    EXPECT_EQ(different(frame.mask, many ? brute_force_words(frame) : brute_force_mask(frame)), 0u);
    expect_explained(frame);
    EXPECT_GT(receivers(frame), 30u);
    if (c.casts) {
      EXPECT_GT(shadowed(frame), 10u);
    }
  }
}

const Settings exact{{"spp", "32"}, {"coverage", "exact"}, {"insertion", "exact"}, {"grid", "128"}};

TEST(LightCases, OfAPointLightCastTheBruteForceMask) {
  const Scene scene = scene_of_cases();
  check(cube_cases(scene), scene, {{"grid", "256"}});
}

TEST(LightCases, OfAPointLightCastTheBruteForceMaskOf32Samples) {
  const Scene scene = scene_of_cases();
  check(cube_cases(scene), scene, exact);
}

TEST(LightCases, OfASunCastTheBruteForceMask) {
  const Scene scene = scene_of_cases();
  check(sun_cases(), scene, {{"grid", "256"}});
  check(sun_cases(), scene, exact);
}

TEST(LightCases, TheMaskOfAPointLightDependsOnNoOption) {
  const Scene scene = scene_of_cases();
  const Light light = cube_cases(scene)[0].light;
  const Frame base = render_frame(scene, camera, light, width_px, height_px, exact);
  for (const Settings& variant : {Settings{{"cascades", "5"}, {"grid", "64"}},
                                  Settings{{"cascades", "2"}, {"cascade-pass", "multiple"}, {"zcull", "off"}}}) {
    const Frame other = render_frame(scene, camera, light, width_px, height_px, with(exact, variant));
    EXPECT_EQ(different(base.mask, other.mask), 0u) << variant[0].second;
  }
}

// The shadow volume has two halves: only the one beyond the triangle, as the light sees it, is in shadow.
TEST(LightCases, ACasterBehindTheLightDoesNotShadow) {
  Scene scene = empty_scene();
  add_soup(scene, floor_of(12.0f));
  add_soup(scene, rectangle({-1.0f, 2.0f, -1.0f}, {0, 0, 2}, {2, 0, 0}));
  const Camera above = look_at({0.3, 9.0, 5.0}, {0, 0, 0}, glm::radians(45.0));
  for (const char* spp : {"1", "32"})
    for (const auto& [height, casts] : {std::pair{1.9, false}, {2.0, false}, {2.1, true}}) {
      const Light light = point_light({0.2, height, 0.1});
      const Frame frame = render_frame(scene, above, light, width_px, height_px, {{"spp", spp}, {"grid", "256"}});
      size_t floor_in_shadow = 0;
      for (size_t i = 0; i < frame.mask.size(); ++i)
        floor_in_shadow += frame.mask[i] != 0u && frame.receivers.own_triangle[i] < 2u;
      EXPECT_EQ(floor_in_shadow > 0, casts) << height;
    }
}

}  // namespace
}  // namespace izb::test
