// SPDX-License-Identifier: MIT
// Camera paths: through their keys, smoothly, and files that are none.
#include <gtest/gtest.h>

#include "base/error.h"
#include "cpu/gltf_writer.h"
#include "scene/camera_path.h"

namespace izb::test {
namespace {

glm::dvec3 eye(const CameraPath& path, double time_s) {
  return glm::dvec3(path.at(time_s).world_from_view[3]);
}

glm::dvec3 forward(const CameraPath& path, double time_s) {
  return -glm::dvec3(path.at(time_s).world_from_view[2]);
}

CameraPath path_of(const std::vector<CameraPath::Key>& keys) {
  CameraPath path;
  path.keys = keys;
  return path;
}

TEST(CameraPath, PassesThroughItsKeysAndStandsAtItsEnds) {
  const CameraPath path =
      path_of({{1.0, {0, 1, 5}, {0, 0, 0}, 40}, {1.5, {3, 2, 5}, {1, 0, 0}, 50}, {4.0, {8, 1, -2}, {0, 1, 0}, 60}});
  for (const CameraPath::Key& key : path.keys) {
    EXPECT_NEAR(glm::distance(eye(path, key.time_s), key.eye_ws), 0.0, 1e-12);
    EXPECT_NEAR(glm::dot(forward(path, key.time_s), glm::normalize(key.target_ws - key.eye_ws)), 1.0, 1e-12);
    EXPECT_NEAR(path.at(key.time_s).yfov_rad, glm::radians(key.yfov_deg), 1e-12);
  }
  EXPECT_EQ(eye(path, -3.0), eye(path, 1.0));
  EXPECT_EQ(eye(path, 99.0), eye(path, 4.0));
}

TEST(CameraPath, FollowsAParabolaExactly) {
  // Bessel's tangents are those of parabolas, so that a path along one, with keys at unequal times, is that.
  const auto at = [](double t) { return glm::dvec3(2.0 * t, t * t - t, 3.0 - 0.5 * t * t); };
  CameraPath path;
  for (const double t : {0.0, 0.4, 1.0, 1.1, 2.0}) path.keys.push_back({t, at(t), {0, 0, -50}, 45});
  for (double t = 0.4; t < 1.1; t += 0.05) EXPECT_NEAR(glm::distance(eye(path, t), at(t)), 0.0, 1e-12) << t;
}

TEST(CameraPath, TheSpeedHasNoJump) {
  const CameraPath path = path_of({{0.0, {0, 0, 5}, {0, 0, 0}, 40},
                                   {1.0, {4, 0, 5}, {1, 0, 0}, 50},
                                   {1.2, {5, 3, 4}, {0, 1, 0}, 60},
                                   {3.0, {0, 9, 4}, {0, 1, 1}, 60}});
  constexpr double step_s = 1e-6;
  for (const double t : {1.0, 1.2}) {
    const glm::dvec3 before = (eye(path, t) - eye(path, t - step_s)) / step_s;
    const glm::dvec3 after = (eye(path, t + step_s) - eye(path, t)) / step_s;
    EXPECT_LT(glm::distance(before, after), 1e-3 * glm::length(before)) << t;
  }
}

TEST(CameraPath, IsReadFromAFile) {
  const TemporaryFolder folder;
  const auto file = write_file(folder / "path.json",
                               R"({"keys": [{"time": 0, "eye": [0, 1, 2], "target": [0, 0, 0], "fov": 30},
                                            {"time": 2.5, "eye": [4, 1, 2], "target": [0, 0, 0]}]})");
  const CameraPath path = read_camera_path(file);
  ASSERT_EQ(path.keys.size(), 2u);
  EXPECT_EQ(path.keys[1].time_s, 2.5);
  EXPECT_EQ(path.keys[1].eye_ws, glm::dvec3(4, 1, 2));
  EXPECT_EQ(path.keys[1].yfov_deg, 30.0);
}

TEST(CameraPath, OtherFilesAreSentences) {
  const TemporaryFolder folder;
  const std::pair<const char*, const char*> cases[] = {
      {"[", "it is no JSON"},
      {"[]", "no array 'keys'"},
      {R"({"keys": []})", "at least one key"},
      {R"({"keys": [3]})", "key 0 is not an object"},
      {R"({"keys": [{"eye": [0, 1, 2], "target": [0, 0, 0]}]})", "'time' is not a number"},
      {R"({"keys": [{"time": 0, "eye": [0, 1], "target": [0, 0, 0]}]})", "'eye' is not an array of 3 numbers"},
      {R"({"keys": [{"time": 0, "eye": [0, 1, "x"], "target": [0, 0, 0]}]})", "'eye' is not a number"},
      {R"({"keys": [{"time": 0, "eye": [0, 1, 1], "target": [0, 1, 1]}]})", "are the same point"},
      {R"({"keys": [{"time": 0, "eye": [0, 1, 1], "target": [0, 0, 0], "fov": 180}]})", "'fov' is not between"},
      {R"({"keys": [{"time": 0, "eye": [0, 1, 1], "target": [0, 0, 0]},
                    {"time": 0, "eye": [0, 1, 2], "target": [0, 0, 0]}]})",
       "key 1: its time is not after"}};
  for (const auto& [text, cause] : cases) {
    const auto file = write_file(folder / "path.json", text);
    try {
      read_camera_path(file);
      ADD_FAILURE() << text << " was read";
    } catch (const Error& e) {
      const std::string sentence = e.what();
      EXPECT_NE(sentence.find(cause), std::string::npos) << sentence;
      EXPECT_NE(sentence.find("path.json"), std::string::npos) << sentence;
    }
  }
  EXPECT_THROW(read_camera_path(folder / "none.json"), Error);
}

}  // namespace
}  // namespace izb::test
