// SPDX-License-Identifier: MIT
#include "view/path_recorder.h"

#include <nlohmann/json.hpp>
#include <stdexcept>

namespace izb {
namespace {

CameraPath::Key key_of(double time_s, const CameraPose& pose) {
  return {time_s, pose.eye_ws, pose.target_ws, pose.yfov_deg};
}

}  // namespace

void PathRecorder::add(double now_s, const CameraPose& pose, double interval_s) {
  if (path_.keys.empty()) start_s_ = now_s;
  const double time_s = now_s - start_s_;
  if (!path_.keys.empty() && time_s < path_.keys.back().time_s + interval_s) return;
  path_.keys.push_back(key_of(time_s, pose));
}

void PathRecorder::end(double now_s, const CameraPose& pose) {
  if (path_.keys.empty()) throw std::logic_error("a path ends that was not begun");
  const double time_s = now_s - start_s_;
  if (time_s > path_.keys.back().time_s) path_.keys.push_back(key_of(time_s, pose));
}

std::string camera_path_json(const CameraPath& path) {
  nlohmann::json keys = nlohmann::json::array();
  const auto triple = [](const glm::dvec3& v) { return nlohmann::json::array({v.x, v.y, v.z}); };
  for (const CameraPath::Key& key : path.keys)
    keys.push_back(
        {{"time", key.time_s}, {"eye", triple(key.eye_ws)}, {"target", triple(key.target_ws)}, {"fov", key.yfov_deg}});
  return nlohmann::json{{"keys", keys}}.dump(1) + "\n";
}

}  // namespace izb
