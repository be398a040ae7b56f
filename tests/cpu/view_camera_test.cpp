// SPDX-License-Identifier: MIT
// How a person moves cameras and lights.
#include <gtest/gtest.h>

#include <glm/gtc/constants.hpp>

#include "scene/view.h"
#include "view/camera_control.h"
#include "view/opening.h"

namespace izb::test {
namespace {

constexpr double quarter = glm::half_pi<double>();

void expect_near(const glm::dvec3& a, const glm::dvec3& b, double tolerance = 1e-12) {
  EXPECT_LT(glm::distance(a, b), tolerance) << text_of(a) << " and " << text_of(b);
}

/// Two lights and a camera around a triangle.
Scene small_scene() {
  Scene scene;
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.indices = {0, 1, 2};
  scene.meshes = {mesh};
  scene.materials.resize(1);
  scene.instances.resize(1);
  Light spot;
  spot.name = "lamp";
  spot.type = LightType::spot;
  spot.position_ws = {1, 2, 3};
  Light sunlight = sun(30.0, 20.0);
  sunlight.name = "a;b";
  scene.lights = {spot, sunlight};
  return scene;
}

TEST(CameraPose, OrbitsAroundItsFocusAndNeverTipsOver) {
  CameraPose pose{{0, 0, 5}, {0, 0, 0}, 45.0};
  pose.orbit(quarter, 0.0);
  expect_near(pose.eye_ws, {-5, 0, 0});
  expect_near(pose.target_ws, {0, 0, 0});
  for (int i = 0; i < 100; ++i) pose.orbit(0.1, -0.3);
  EXPECT_NEAR(pose.distance(), 5.0, 1e-9);
  EXPECT_GT(pose.eye_ws.y, 4.99);
  EXPECT_TRUE(std::isfinite(pose.right().x));
  EXPECT_GT(pose.up().y, 0.0);
}

TEST(CameraPose, LooksMovesAndApproachesWithoutLosingItsFocusDistance) {
  CameraPose pose{{0, 0, 5}, {0, 0, 0}, 45.0};
  pose.look(quarter, 0.0);
  expect_near(pose.eye_ws, {0, 0, 5});
  expect_near(pose.target_ws, {5, 0, 5});
  pose.move({1.0, 2.0, 3.0});
  expect_near(pose.eye_ws, {3, 2, 6});
  expect_near(pose.target_ws, {8, 2, 6});
  pose.approach(0.5);
  expect_near(pose.eye_ws, {5.5, 2, 6});
  pose.focus({5.5, 2, -4});
  EXPECT_NEAR(pose.distance(), 10.0, 1e-12);
}

TEST(CameraPose, NeverReachesItsFocus) {
  CameraPose pose{{0, 0, 5}, {0, 0, 0}, 45.0};
  for (int i = 0; i < 1000; ++i) pose.approach(0.88);
  EXPECT_GT(pose.distance(), 0.0);
  pose.orbit(quarter, 0.1);
  EXPECT_TRUE(std::isfinite(pose.eye_ws.x) && std::isfinite(pose.right().x));
  for (int i = 0; i < 1000; ++i) pose.approach(1.2);
  EXPECT_LE(pose.distance(), 1.001e12);
}

TEST(CameraPose, GoesThroughTheCommandLineWithoutLosingABit) {
  FrameOptions options;
  options.camera = "main";
  CameraPose pose{{1.0 / 3.0, -2e-17, 5e20}, {0.1, 0.2, -0.3}, 33.3};
  pose.put_into(options);
  EXPECT_EQ(options.camera, "");
  EXPECT_EQ(options.eye, "0.3333333333333333,-2e-17,5e+20");
  const Scene scene = small_scene();
  const Camera camera = choose_frame(options, scene).camera;
  EXPECT_EQ(camera.world_from_view, look_at(pose.eye_ws, pose.target_ws, glm::radians(33.3)).world_from_view);
}

TEST(CameraPose, TakesTheSceneCameraOver) {
  const Camera camera = look_at({1, 2, 3}, {4, 2, -1}, 0.7);
  const CameraPose pose = CameraPose::of(camera, 5.0);
  expect_near(pose.eye_ws, {1, 2, 3});
  expect_near(pose.target_ws, {4, 2, -1});
  EXPECT_NEAR(glm::radians(pose.yfov_deg), 0.7, 1e-12);
  Camera parallel = camera;
  parallel.orthographic = true;
  parallel.ymag = 2.0;
  const CameraPose perspective = CameraPose::of(parallel, 5.0);
  EXPECT_NEAR(perspective.distance() * std::tan(glm::radians(0.5 * perspective.yfov_deg)), 2.0, 1e-9);
}

TEST(CameraPose, APixelShowsThePointThatItsDepthSays) {
  const Camera camera = look_at({0, 0, 5}, {0, 0, 0}, quarter);  // 45 degrees up and down
  expect_near(point_of_pixel(camera, 200, 100, {100, 50}, 5.0), {0, 0, 0});
  expect_near(point_of_pixel(camera, 200, 100, {200, 0}, 5.0), {10, 5, 0});
  Camera parallel = camera;
  parallel.orthographic = true;
  parallel.ymag = 3.0;
  expect_near(point_of_pixel(parallel, 200, 100, {0, 100}, 4.0), {-6, -3, 1});
}

TEST(Lights, AreMovedWhereTheOptionsHaveThem) {
  const Scene scene = small_scene();
  FrameOptions options;
  options.light = "lamp";
  options.sun = "10,20;30,40";
  options.point = "1,2,3";
  std::vector<Light> lights = choose_frame(options, scene).lights;
  ASSERT_EQ(lights.size(), 4u);
  for (size_t i = 0; i < lights.size(); ++i) {
    Light moved = lights[i];
    if (moved.type != LightType::point) moved.direction_ws = turned(moved.direction_ws, 0.3, 0.1);
    if (moved.type != LightType::directional) moved.position_ws += glm::dvec3(0.25, 1.0 / 3.0, -7.0);
    put_light(options, lights, i, moved);
    const std::vector<Light> now = choose_frame(options, scene).lights;
    ASSERT_EQ(now.size(), 4u);
    for (size_t k = 0; k < now.size(); ++k) {
      const Light& expected = k == i ? moved : lights[k];
      expect_near(now[k].direction_ws, expected.direction_ws);
      expect_near(now[k].position_ws, expected.position_ws);
      EXPECT_EQ(now[k].intensity, expected.intensity);
      EXPECT_EQ(now[k].name, expected.name);
    }
    lights = now;
  }
}

TEST(Opening, AFrameSaysByNameWhatWouldHaveBeenChosen) {
  Scene scene = small_scene();
  Poser poser(scene);
  const SceneFacts bare = facts_of("x.glb", scene, poser, {});
  EXPECT_EQ(bare.frame.light, "lamp");
  EXPECT_NE(bare.frame.eye, "");
  EXPECT_EQ(bare.lights, (std::vector<std::string>{"lamp", "1"})) << "a name that reads as a list needs its index";
  scene.lights.clear();
  scene.cameras.push_back(look_at({0, 0, 5}, {0, 0, 0}, 0.7));
  const SceneFacts dark = facts_of("x.glb", scene, poser, {});
  EXPECT_EQ(dark.frame.camera, "0");
  const Light chosen = choose_frame(dark.frame, scene).lights.at(0);
  expect_near(chosen.direction_ws, sun(135.0, 40.0).direction_ws);
  FrameOptions asked;
  asked.sun = "1,2";
  asked.eye = "1,1,1";
  asked.target = "0,0,0";
  const SceneFacts as_asked = facts_of("x.glb", scene, poser, asked);
  EXPECT_EQ(as_asked.frame.sun, "1,2");
  EXPECT_EQ(as_asked.frame.eye, "1,1,1");
  EXPECT_EQ(as_asked.frame.camera, "");
}

}  // namespace
}  // namespace izb::test
