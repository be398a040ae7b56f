// SPDX-License-Identifier: MIT
#include "view/opening.h"

#include <algorithm>

#include "app/session.h"
#include "base/error.h"
#include "scene/find.h"
#include "scene/view.h"
#include "view/camera_control.h"

namespace izb {
namespace {

/// What finds that object again on a command line: its name, or its index where the name is no one's own.
template <typename T>
std::string label_of(const std::vector<T>& objects, size_t i) {
  const std::string& name = objects[i].name;
  const bool own = !name.empty() && name != "all" && name.find(';') == std::string::npos;
  return own && find_by_name_or_index(objects, name) == &objects[i] ? name : std::to_string(i);
}

template <typename T>
std::vector<std::string> labels_of(const std::vector<T>& objects) {
  std::vector<std::string> labels;
  for (size_t i = 0; i < objects.size(); ++i) labels.push_back(label_of(objects, i));
  return labels;
}

/// What the batch program takes where nothing is asked for, by name.
FrameOptions by_name(const FrameOptions& asked, const Scene& scene) {
  FrameOptions frame = asked;
  const bool no_camera = asked.eye.empty() && asked.camera.empty() && asked.camera_path.empty();
  const bool no_light = asked.light.empty() && asked.sun.empty() && asked.spot.empty() && asked.point.empty();
  if (!asked.viewpoint.empty()) return frame;
  if (no_camera && !scene.cameras.empty()) frame.camera = label_of(scene.cameras, 0);
  if (no_light && !scene.lights.empty()) frame.light = label_of(scene.lights, 0);
  return frame;
}

/// The rest by numbers, as it was chosen.
void by_numbers(FrameOptions& frame, const FrameChoice& choice, const Scene& scene, const glm::dvec3& center_ws) {
  if (frame.eye.empty() && frame.camera.empty() && frame.camera_path.empty())
    CameraPose::of(choice.camera, glm::distance(glm::dvec3(choice.camera.world_from_view[3]), center_ws))
        .put_into(frame);
  frame.viewpoint.clear();
  if (!frame.light.empty() || !frame.sun.empty() || !frame.spot.empty() || !frame.point.empty()) return;
  const Light& chosen = choice.lights.front();
  const auto same = std::find_if(scene.lights.begin(), scene.lights.end(), [&](const Light& l) {
    return l.type == chosen.type && l.position_ws == chosen.position_ws && l.direction_ws == chosen.direction_ws;
  });
  if (same != scene.lights.end()) {
    frame.light = label_of(scene.lights, size_t(same - scene.lights.begin()));
  } else {
    frame.sun = "0,0";
    put_light(frame, choice.lights, 0, chosen);
  }
}

}  // namespace

void pose_scene(Poser& poser, const Scene& scene, const FrameOptions& options) {
  if (animates(options, scene))
    poser.at({options.animation, std::max(options.time_s, 0.0), options.loop});
  else
    poser.at_rest();
}

SceneFacts facts_of(const std::string& file, const Scene& scene, Poser& poser, const FrameOptions& asked) {
  pose_scene(poser, scene, asked);
  SceneFacts facts;
  facts.file = file;
  facts.triangles = scene.triangle_count();
  facts.cameras = labels_of(scene.cameras);
  facts.lights = labels_of(scene.lights);
  facts.animations = labels_of(scene.animations);
  for (const Animation& a : scene.animations) facts.animation_length_s = std::max(facts.animation_length_s, a.length_s);
  const Bounds bounds = world_bounds(scene);
  facts.center_ws = bounds.center();
  facts.radius_ws = bounds.radius() > 0.0 ? bounds.radius() : 1.0;
  facts.ignored = scene.ignored;
  facts.frame = by_name(asked, scene);
  by_numbers(facts.frame, choose_frame(facts.frame, scene), scene, facts.center_ws);
  return facts;
}

}  // namespace izb
