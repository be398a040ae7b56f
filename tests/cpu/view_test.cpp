// SPDX-License-Identifier: MIT
#include "scene/view.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/constants.hpp>

#include "base/error.h"
#include "gltf_writer.h"

namespace izb {
namespace {

using test::write_file;

void expect_near(const glm::dvec3& a, const glm::dvec3& b, double tolerance = 1e-12) {
  EXPECT_LE(glm::distance(a, b), tolerance)
      << "(" << a.x << ", " << a.y << ", " << a.z << ") should be (" << b.x << ", " << b.y << ", " << b.z << ")";
}

void expect_rigid(const Camera& camera) {
  const glm::dmat3 r(camera.world_from_view);
  EXPECT_NEAR(glm::determinant(r), 1.0, 1e-12);
  const glm::dmat3 identity = glm::transpose(r) * r;
  for (int c = 0; c < 3; ++c) expect_near(identity[c], glm::dmat3(1.0)[c]);
}

/// The sentence that a call ends in.
template <typename Call>
std::string sentence(const Call& call) {
  try {
    call();
    return "";
  } catch (const Error& e) {
    return e.what();
  }
}

void expect_sentence(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << "'" << text << "' should say '" << part << "'";
}

Scene scene_with_names() {
  Scene scene;
  scene.name = "yard";
  for (const char* name : {"door", "1", "gate"}) {
    scene.cameras.emplace_back().name = name;
    scene.lights.emplace_back().name = name;
  }
  return scene;
}

TEST(View, WorldBoundsFollowTheInstances) {
  Scene scene;
  EXPECT_TRUE(world_bounds(scene).empty());
  scene.meshes.emplace_back().positions = {{0, 0, 0}, {1, 2, 3}};
  scene.instances.push_back({0, glm::dmat4(-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 10, 1)});
  scene.instances.push_back({0, glm::dmat4(1.0)});
  const Bounds bounds = world_bounds(scene);
  EXPECT_EQ(bounds.min, glm::dvec3(-1, 0, 0));
  EXPECT_EQ(bounds.max, glm::dvec3(1, 2, 13));
}

TEST(View, LookAt) {
  const Camera camera = look_at({5, 1, 2}, {5, 1, -8}, 0.7);
  expect_near(glm::dvec3(camera.world_from_view * glm::dvec4(0, 0, -1, 0)), {0, 0, -1});
  expect_near(glm::dvec3(camera.world_from_view * glm::dvec4(0, 1, 0, 0)), {0, 1, 0});
  expect_near(glm::dvec3(camera.world_from_view[3]), {5, 1, 2});
  EXPECT_EQ(camera.yfov_rad, 0.7);
  EXPECT_FALSE(camera.orthographic);
  EXPECT_GT(camera.near_plane, 0.0);
  EXPECT_LT(camera.near_plane, 0.01);
  EXPECT_TRUE(std::isinf(camera.far_plane));
  for (const glm::dvec3 target : {glm::dvec3(1, 2, 3), glm::dvec3(0, 7, 0), glm::dvec3(0, -7, 0)}) {
    const Camera any = look_at({0, 0, 0}, target, 0.7);
    expect_rigid(any);
    expect_near(-glm::dvec3(any.world_from_view[2]), glm::normalize(target));
  }
  expect_sentence(sentence([] { look_at({1, 1, 1}, {1, 1, 1}, 0.7); }), "same point");
}

TEST(View, DefaultCameraSeesTheWholeSceneFromAbove) {
  for (const double size : {1e-3, 1.0, 1e5}) {
    Bounds bounds;
    bounds.add(size * glm::dvec3(3, -1, 2));
    bounds.add(size * glm::dvec3(5, 4, 9));
    const Camera camera = default_camera(bounds);
    expect_rigid(camera);
    const glm::dmat4 view_from_world = glm::inverse(camera.world_from_view);
    double highest = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
      const glm::dvec3 p((corner & 1) ? bounds.max.x : bounds.min.x, (corner & 2) ? bounds.max.y : bounds.min.y,
                         (corner & 4) ? bounds.max.z : bounds.min.z);
      const glm::dvec3 vs(view_from_world * glm::dvec4(p, 1.0));
      EXPECT_LT(vs.z, -camera.near_plane);
      const double slope = std::tan(0.5 * camera.yfov_rad);
      highest = std::max({highest, std::abs(vs.y / vs.z) / slope, std::abs(vs.x / vs.z) / slope});
    }
    EXPECT_LE(highest, 1.0);
    EXPECT_GE(highest, 0.5) << "the scene should fill the picture";
    EXPECT_GT(camera.world_from_view[3].y, bounds.max.y);
    EXPECT_NEAR(camera.yfov_rad, glm::radians(45.0), 1e-12);
  }
  expect_rigid(default_camera(Bounds{}));
}

TEST(View, SunComesFromItsAzimuthAndElevation) {
  expect_near(sun(0, 0).direction_ws, {0, 0, 1});    // in the north (-z): shines to the south
  expect_near(sun(90, 0).direction_ws, {-1, 0, 0});  // in the east (+x)
  expect_near(sun(123, 90).direction_ws, {0, -1, 0});
  expect_near(sun(180, 45).direction_ws, glm::normalize(glm::dvec3(0, -1, -1)));
  EXPECT_EQ(sun(0, 0).type, LightType::directional);
  EXPECT_NEAR(glm::length(sun(17, 33).direction_ws), 1.0, 1e-12);
}

TEST(View, FindByNameThenByIndex) {
  const Scene scene = scene_with_names();
  EXPECT_EQ(&find_camera(scene, "gate"), &scene.cameras[2]);
  EXPECT_EQ(&find_camera(scene, "0"), &scene.cameras[0]);
  EXPECT_EQ(&find_camera(scene, "1"), &scene.cameras[1]) << "a name that looks like an index";
  EXPECT_EQ(&find_light(scene, "2"), &scene.lights[2]);
  for (const char* unknown : {"3", "-1", "0x", "", "Door"}) {
    const std::string text = sentence([&] { find_camera(scene, unknown); });
    expect_sentence(text, "'yard' has no camera '" + std::string(unknown) + "'");
    expect_sentence(text, "0 'door', 1 '1', 2 'gate'");
  }
  expect_sentence(sentence([&] { find_light(Scene{}, "0"); }), "none at all");
}

class Viewpoints : public testing::Test {
 protected:
  test::TemporaryFolder folder;
  std::string error(const std::string& text, const std::string& name = "a") {
    const auto file = write_file(folder / "views.json", text);
    const std::string message = sentence([&] { read_viewpoint(file, name); });
    expect_sentence(message, file.string());
    return message;
  }
};

TEST_F(Viewpoints, AreRead) {
  const auto file = write_file(folder / "views.json",
                               R"({"a": {"eye": [1, 2, 3], "target": [0, 0.5, 0], "fov": 30, "sun": [90, 20]},
                                   "b": {"eye": [1, 2, 3], "target": [0, 0, 0], "light": "lamp"}})");
  const Viewpoint a = read_viewpoint(file, "a"), b = read_viewpoint(file, "b");
  EXPECT_EQ(a.eye_ws, glm::dvec3(1, 2, 3));
  EXPECT_EQ(a.target_ws, glm::dvec3(0, 0.5, 0));
  EXPECT_EQ(a.yfov_deg, 30.0);
  EXPECT_EQ(a.sun_deg, glm::dvec2(90, 20));
  EXPECT_FALSE(a.light);
  EXPECT_EQ(b.yfov_deg, 45.0);
  EXPECT_EQ(b.light, "lamp");
  EXPECT_FALSE(b.sun_deg);
}

TEST_F(Viewpoints, ErrorsNameTheFileAndTheCause) {
  expect_sentence(sentence([&] { read_viewpoint(folder / "absent.json", "a"); }), "absent.json");
  expect_sentence(error("not json"), "not a JSON object");
  expect_sentence(error("[]"), "not a JSON object");
  expect_sentence(error(R"({"b": {}, "c": {}})"), "no view 'a'; there are b, c");
  expect_sentence(error(R"({"a": 1})"), "not an object");
  expect_sentence(error(R"({"a": {"eye": [1, 2, 3]}})"), "has no 'target'");
  expect_sentence(error(R"({"a": {"eye": [1, 2], "target": [0, 0, 0]}})"), "'eye' is not an array of 3 numbers");
  expect_sentence(error(R"({"a": {"eye": [1, 2, "x"], "target": [0, 0, 0]}})"), "'eye'");
  expect_sentence(error(R"({"a": {"eye": [0, 0, 0], "target": [0, 0, 0]}})"), "same point");
  expect_sentence(error(R"({"a": {"eye": [1, 0, 0], "target": [0, 0, 0], "fov": 180}})"), "'fov'");
  expect_sentence(error(R"({"a": {"eye": [1, 0, 0], "target": [0, 0, 0], "light": 0}})"), "'light'");
  expect_sentence(error(R"({"a": {"eye": [1, 0, 0], "target": [0, 0, 0], "sun": [1]}})"), "'sun'");
  expect_sentence(error(R"({"a": {"eye": [1, 0, 0], "target": [0, 0, 0], "sun": [1, 2], "light": "x"}})"), "both");
}

}  // namespace
}  // namespace izb
