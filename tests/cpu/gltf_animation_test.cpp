// SPDX-License-Identifier: MIT
// Animations at one moment: every interpolation and property, against values worked out by hand.
#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "cpu/gltf_writer.h"
#include "scene/gltf.h"
#include "scene/pose.h"
#include "scene/view.h"

namespace izb::test {
namespace {

/// Adds a channel to the file's animation number 0.
void animate(GltfWriter& gltf, int node, const char* path, const std::vector<float>& times, int output,
             const char* interpolation = nullptr) {
  if (!gltf.root.contains("animations"))
    gltf.append("animations", {{"name", "move"}, {"channels", json::array()}, {"samplers", json::array()}});
  json& animation = gltf.root["animations"][0];
  json sampler = {{"input", gltf.add_array(times, type_float, "SCALAR", 1)}, {"output", output}};
  if (interpolation) sampler["interpolation"] = interpolation;
  animation["channels"].push_back(
      {{"sampler", animation["samplers"].size()}, {"target", {{"node", node}, {"path", path}}}});
  animation["samplers"].push_back(sampler);
}

int vec3s(GltfWriter& gltf, const std::vector<float>& values) {
  return gltf.add_array(values, type_float, "VEC3", 3);
}
int vec4s(GltfWriter& gltf, const std::vector<float>& values) {
  return gltf.add_array(values, type_float, "VEC4", 4);
}
int scalars(GltfWriter& gltf, const std::vector<float>& values) {
  return gltf.add_array(values, type_float, "SCALAR", 1);
}

std::vector<glm::dvec3> posed(const Scene& scene) {
  return posed_positions_ws(scene, scene.instances[0]);
}

struct GltfAnimation : testing::Test {
  const TemporaryFolder folder;

  Scene at(const GltfWriter& gltf, double time_s, const std::string& animation = "") const {
    Scene scene = load_gltf(write_file(folder / "animated.glb", gltf.glb()), false);
    Poser(scene).at({animation, time_s});
    return scene;
  }
  glm::dmat4 placed(const GltfWriter& gltf, double time_s) const {
    return at(gltf, time_s).instances[0].world_from_object;
  }
  std::string refusal(const GltfWriter& gltf, const std::string& animation = "") const {
    try {
      at(gltf, 0.5, animation);
    } catch (const Error& e) {
      return e.what();
    }
    return "no refusal";
  }
};

TEST_F(GltfAnimation, TranslationsAreLinearStepsOrSplines) {
  const std::vector<float> times{1, 3}, keys{0, 0, 0, 4, -8, 2};
  GltfWriter linear = one_triangle(), step = one_triangle(), spline = one_triangle();
  animate(linear, 0, "translation", times, vec3s(linear, keys));
  animate(step, 0, "translation", times, vec3s(step, keys), "STEP");
  // In-tangent, value, out-tangent of each key; x leaves with speed 3 and arrives with speed -1.
  animate(spline, 0, "translation", times, vec3s(spline, {9, 9, 9, 0, 0, 0, 3, 0, 0, -1, 0, 0, 4, -8, 2, 9, 9, 9}),
          "CUBICSPLINE");
  const struct {
    double time_s, linear_x, step_x, spline_x;
  } expected[] = {{0.0, 0, 0, 0},       {1.0, 0, 0, 0}, {1.5, 1, 0, 0}, {2.0, 2, 0, 0},
                  {2.999, 3.998, 0, 0}, {3.0, 4, 4, 4}, {9.0, 4, 4, 4}};
  for (const auto& e : expected) {
    EXPECT_NEAR(placed(linear, e.time_s)[3].x, e.linear_x, 1e-9) << e.time_s;
    EXPECT_NEAR(placed(linear, e.time_s)[3].y, -2.0 * e.linear_x, 1e-9) << e.time_s;
    EXPECT_NEAR(placed(step, e.time_s)[3].x, e.step_x, 1e-9) << e.time_s;
  }
  // Hermite at u = 1/4 and 1/2 of an interval of 2 s.
  for (const double u : {0.25, 0.5}) {
    const double h01 = u * u * (3 - 2 * u), h10 = u * (1 - u) * (1 - u), h11 = u * u * (u - 1);
    EXPECT_NEAR(placed(spline, 1.0 + 2.0 * u)[3].x, 4 * h01 + 2 * (3 * h10 - 1 * h11), 1e-9) << u;
  }
  EXPECT_EQ(placed(spline, 0.0)[3].x, 0.0);
  EXPECT_EQ(placed(spline, 5.0)[3].x, 4.0);
}

TEST_F(GltfAnimation, RotationsTurnAtEvenSpeedTheShortWay) {
  const float s = std::sqrt(0.5f);
  for (const float sign : {1.0f, -1.0f}) {  // the negated quaternion is the same rotation
    GltfWriter gltf = one_triangle();
    animate(gltf, 0, "rotation", {0, 1}, vec4s(gltf, {0, 0, 0, 1, 0, sign * s, 0, sign * s}));
    for (const double u : {0.25, 0.5, 0.9}) {
      const glm::dmat4 m = placed(gltf, u);
      const double angle = u * glm::radians(90.0);
      EXPECT_NEAR(m[0].x, std::cos(angle), 1e-7) << u;
      EXPECT_NEAR(m[0].z, -std::sin(angle), 1e-7) << u;
      EXPECT_NEAR(m[1].y, 1.0, 1e-7) << u;
    }
  }
  // As normalised shorts, and by a spline whose value is no longer of unit length in between.
  GltfWriter shorts = one_triangle();
  const int output = shorts.add_array(std::vector<int16_t>{0, 0, 0, 32767, 0, 32767, 0, 0}, type_int16, "VEC4", 4);
  shorts.root["accessors"][static_cast<size_t>(output)]["normalized"] = true;
  animate(shorts, 0, "rotation", {0, 1}, output);
  EXPECT_NEAR(std::abs(placed(shorts, 0.5)[0].z), 1.0, 1e-6);
  GltfWriter spline = one_triangle();
  animate(spline, 0, "rotation", {0, 1},
          vec4s(spline, {0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, s, 0, s, 0, 0, 0, 0}), "CUBICSPLINE");
  EXPECT_NEAR(glm::determinant(glm::dmat3(placed(spline, 0.4))), 1.0, 1e-9);
  EXPECT_NEAR(placed(spline, 0.5)[0].x, std::cos(glm::radians(45.0)), 1e-7);
}

TEST_F(GltfAnimation, AParentMovesItsChildrenCamerasAndLights) {
  GltfWriter gltf = one_triangle();
  gltf.append("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 0.9}, {"znear", 0.1}}}});
  gltf.root["extensionsUsed"] = {"KHR_lights_punctual"};
  gltf.root["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}}};
  json lamp = {{"translation", {0, 1, 0}}};
  lamp["extensions"]["KHR_lights_punctual"]["light"] = 0;
  const int camera = gltf.append("nodes", {{"camera", 0}}), light = gltf.append("nodes", lamp);
  const int parent = gltf.append("nodes", {{"children", {0, camera, light}}});
  gltf.root["scenes"][0]["nodes"] = {parent};
  animate(gltf, parent, "translation", {0, 2}, vec3s(gltf, {0, 0, 0, 10, 0, 0}));
  animate(gltf, parent, "scale", {0, 2}, vec3s(gltf, {1, 1, 1, 3, 3, 3}));
  const Scene scene = at(gltf, 1.0);
  EXPECT_EQ(scene.instances[0].world_from_object[3].x, 5.0);
  EXPECT_EQ(scene.instances[0].world_from_object[0].x, 2.0);
  EXPECT_EQ(scene.cameras[0].world_from_view[3].x, 5.0);
  EXPECT_EQ(scene.lights[0].position_ws, glm::dvec3(5.0, 2.0, 0.0));
  ASSERT_EQ(scene.animations.size(), 1u);
  EXPECT_EQ(scene.animations[0].name, "move");
  EXPECT_EQ(scene.animations[0].length_s, 2.0);
}

TEST_F(GltfAnimation, MorphWeightsAreInterpolated) {
  GltfWriter gltf = one_triangle();
  json& primitive = gltf.root["meshes"][0]["primitives"][0];
  primitive["targets"] = json::array();
  for (const float z : {1.0f, 10.0f})
    primitive["targets"].push_back({{"POSITION", gltf.add_positions({0, 0, z, 0, 0, z, 0, 0, z})}});
  gltf.root["meshes"][0]["weights"] = {1, 1};  // what the animation says counts
  animate(gltf, 0, "weights", {0, 1, 2}, scalars(gltf, {0, 0, 1, 0, 0, 1}));
  for (const auto& [time_s, z] : {std::pair{0.0, 0.0}, {0.5, 0.5}, {1.0, 1.0}, {1.25, 0.75 + 2.5}, {3.0, 10.0}})
    EXPECT_NEAR(posed(at(gltf, time_s))[0].z, z, 1e-6) << time_s;
}

TEST_F(GltfAnimation, ASkinFollowsItsJoints) {
  GltfWriter gltf = one_triangle();
  json& attributes = gltf.root["meshes"][0]["primitives"][0]["attributes"];
  attributes["JOINTS_0"] =
      gltf.add_array(std::vector<uint8_t>{0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0}, type_uint8, "VEC4", 4);
  // The first vertex follows joint 0, the second joint 1, the third both.
  attributes["WEIGHTS_0"] = vec4s(gltf, {1, 0, 0, 0, 0, 1, 0, 0, 0.5, 0.5, 0, 0});
  const int still = gltf.add_root({{"name", "still"}}), moving = gltf.add_root({{"name", "moving"}});
  gltf.root["skins"] = {{{"joints", {still, moving}}}};
  gltf.root["nodes"][0]["skin"] = 0;
  gltf.root["nodes"][0]["translation"] = {100, 0, 0};  // without effect
  animate(gltf, moving, "translation", {0, 4}, vec3s(gltf, {0, 0, 0, 0, 0, 8}));
  const Scene scene = at(gltf, 1.0);
  const std::vector<glm::dvec3> world = posed(scene);
  EXPECT_NEAR(glm::distance(world[0], glm::dvec3(0, 0, 0)), 0.0, 1e-6);
  EXPECT_NEAR(glm::distance(world[1], glm::dvec3(1, 0, 2)), 0.0, 1e-6);
  EXPECT_NEAR(glm::distance(world[2], glm::dvec3(0, 1, 1)), 0.0, 1e-6);
  EXPECT_TRUE(scene.ignored.empty()) << scene.ignored[0];
}

TEST_F(GltfAnimation, IsPosedAgainWithoutLoading) {
  GltfWriter gltf = one_triangle();
  animate(gltf, 0, "translation", {0, 2}, vec3s(gltf, {0, 0, 0, 10, 0, 0}));
  json second = gltf.root["animations"][0];
  second["name"] = "turn";
  second["channels"][0]["target"]["path"] = "scale";
  gltf.append("animations", second);
  gltf.root["nodes"][0]["translation"] = {7, 0, 0};
  Scene scene = at(gltf, 1.5);
  Poser poser(scene);
  EXPECT_EQ(scene.instances[0].world_from_object[3].x, 7.5);
  poser.at({"move", 0.5});
  EXPECT_EQ(scene.instances[0].world_from_object[3].x, 2.5);
  poser.at({"turn", 1.0});  // what another animation moved is at rest again
  EXPECT_EQ(scene.instances[0].world_from_object[3].x, 7.0);
  EXPECT_EQ(scene.instances[0].world_from_object[0].x, 5.0);
  for (const char* both : {"all", "move;1"}) {
    poser.at({both, 0.5});
    EXPECT_EQ(scene.instances[0].world_from_object[3].x, 2.5) << both;
    EXPECT_EQ(scene.instances[0].world_from_object[0].x, 2.5) << both;
  }
  poser.at({"move", 4.5, true});
  EXPECT_EQ(scene.instances[0].world_from_object[3].x, 2.5);
  poser.at_rest();
  EXPECT_EQ(scene.instances[0].world_from_object[0].x, 1.0);
}

TEST_F(GltfAnimation, IsChosenByNameOrIndex) {
  GltfWriter gltf = one_triangle();
  animate(gltf, 0, "translation", {0, 1}, vec3s(gltf, {0, 0, 0, 1, 0, 0}));
  json second = gltf.root["animations"][0];
  second["name"] = "other";
  second["samplers"][0]["output"] = vec3s(gltf, {0, 5, 0, 0, 5, 0});
  gltf.append("animations", second);
  EXPECT_EQ(at(gltf, 1.0).instances[0].world_from_object[3].x, 1.0);
  for (const char* name : {"other", "1"})
    EXPECT_EQ(at(gltf, 1.0, name).instances[0].world_from_object[3].y, 5.0) << name;
  const std::string sentence = refusal(gltf, "third");
  for (const char* word : {"third", "'move'", "'other'"}) EXPECT_NE(sentence.find(word), std::string::npos) << sentence;
  EXPECT_NE(refusal(one_triangle()).find("it has no animation"), std::string::npos);
}

TEST_F(GltfAnimation, BadOnesAreSentences) {
  GltfWriter good = one_triangle();
  animate(good, 0, "translation", {0, 1}, vec3s(good, {0, 0, 0, 1, 0, 0}));
  const auto expect = [&](const std::string& part, auto&& change) {
    GltfWriter gltf = good;
    change(gltf, gltf.root["animations"][0]);
    const std::string sentence = refusal(gltf);
    EXPECT_NE(sentence.find(part), std::string::npos) << sentence;
  };
  expect("number of samplers is 1", [](GltfWriter&, json& a) { a["channels"][0]["sampler"] = 3; });
  expect("target.node is 7", [](GltfWriter&, json& a) { a["channels"][0]["target"]["node"] = 7; });
  expect("has no 'path'", [](GltfWriter&, json& a) { a["channels"][0]["target"].erase("path"); });
  expect("no interpolation 'SMOOTH'", [](GltfWriter&, json& a) { a["samplers"][0]["interpolation"] = "SMOOTH"; });
  expect("numbers for 2 keys", [](GltfWriter&, json& a) { a["samplers"][0]["interpolation"] = "CUBICSPLINE"; });
  expect("is not of type VEC4", [](GltfWriter&, json& a) { a["channels"][0]["target"]["path"] = "rotation"; });
  expect("is not after that before", [](GltfWriter& g, json& a) { a["samplers"][0]["input"] = scalars(g, {1, 1}); });
  expect("time of key 0 is not finite", [](GltfWriter& g, json& a) {
    a["samplers"][0]["input"] = scalars(g, {std::nanf(""), 1});
  });
  expect("a value is not finite", [](GltfWriter& g, json& a) {
    a["samplers"][0]["output"] = vec3s(g, {0, 0, 0, INFINITY, 0, 0});
  });
  expect("numbers for 3 keys", [](GltfWriter& g, json& a) { a["samplers"][0]["input"] = scalars(g, {0, 1, 2}); });
  expect("has a matrix",
         [](GltfWriter& g, json&) { g.root["nodes"][0]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}; });
  // What an extension animates is no business of ours.
  GltfWriter pointer = good;
  pointer.root["animations"][0]["channels"][0]["target"] = {{"path", "pointer"}};
  EXPECT_EQ(refusal(pointer), "no refusal");
}

}  // namespace
}  // namespace izb::test
