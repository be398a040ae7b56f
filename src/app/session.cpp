// SPDX-License-Identifier: MIT
#include "app/session.h"

#include "base/error.h"
#include "base/log.h"
#include "base/progress.h"
#include "scene/gltf.h"

namespace izb {

namespace {

/// The value of `--name VALUE` or `--name=VALUE`, the last one given.
std::string value_of(const std::vector<std::string>& arguments, const std::string& name) {
  std::string value;
  for (size_t i = 0; i < arguments.size(); ++i) {
    if (arguments[i] == "--" + name && i + 1 < arguments.size()) value = arguments[i + 1];
    if (arguments[i].starts_with("--" + name + "=")) value = arguments[i].substr(name.size() + 3);
  }
  return value;
}

}  // namespace

std::unique_ptr<Technique> technique_of(const std::vector<std::string>& arguments) {
  const std::vector<std::string> names = technique_names();
  const std::string name = value_of(arguments, "technique"), preset = value_of(arguments, "preset");
  // An unknown name is refused by the option itself, with the list of names.
  const bool known = std::find(names.begin(), names.end(), name) != names.end();
  std::unique_ptr<Technique> technique = make_technique(known ? name : names.front());
  if (!preset.empty()) technique->apply_preset(preset);
  return technique;
}

void copy_options(Technique& from, Technique& to) {
  const OptionSet given = from.options(), taken = to.options();
  for (size_t i = 0; i < taken.options().size(); ++i)
    std::visit([&](auto* value) { *value = *std::get<decltype(value)>(given.options()[i].value); },
               taken.options()[i].value);
}

std::unique_ptr<Technique> another(Technique& technique) {
  std::unique_ptr<Technique> copy = make_technique(technique.info().name);
  copy_options(technique, *copy);
  return copy;
}

bool animates(const FrameOptions& options, const Scene& scene) {
  if (!options.plays()) return false;
  return !options.animation.empty() || options.camera_path.empty() || !scene.animations.empty();
}

namespace {

Scene load_with_progress(const std::string& path, bool plays) {
  constexpr uint64_t steps = 1000;
  Progress progress("loading " + path, steps);
  uint64_t done = 0;
  return load_gltf(path, !plays, [&](double share) {
    const auto now = static_cast<uint64_t>(share * steps);
    progress.advance(now - done);
    done = now;
  });
}

}  // namespace

Session::Session(const FrameOptions& options, std::unique_ptr<Technique> its_technique, const std::string& scene_path)
    : scene(load_with_progress(scene_path, options.plays())),
      poser(scene),
      moment{options.animation, std::max(options.time_s, 0.0), options.loop},
      plays(animates(options, scene)),
      frame(choose_first_frame(options, scene_path)),
      gl(options.context),
      technique(std::move(its_technique)),
      renderer(scene, gl.capabilities),
      timers(gl.capabilities.software) {
  for (const std::string& sentence : scene.ignored) note("{}: {}", scene_path, sentence);
  renderer.prepare(*technique, frame.size.width_px, frame.size.height_px, frame.lights);
}

FrameChoice Session::choose_first_frame(const FrameOptions& options, const std::string& scene_path) {
  try {
    pose();
  } catch (const Error& e) {
    fail("cannot pose '{}': {}", scene_path, e.what());
  }
  return choose_frame(options, scene);
}

void Session::pose() {
  if (plays)
    poser.at(moment);
  else
    poser.at_rest();
}

void Session::move_to(double time_s) {
  moment.time_s = time_s;
  pose();
  frame.move(poser, time_s);
}

}  // namespace izb
