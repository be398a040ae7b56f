// SPDX-License-Identifier: MIT
// What a key and a button both do.
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <fstream>

#include "app/session.h"
#include "base/error.h"
#include "base/file.h"
#include "view/window/ui.h"

namespace izb {

void Ui::leave_path() {
  state_.frame.camera_path.clear();
  replay_start_s_.reset();
  if (facts_->animations.empty()) state_.frame.time_s = -1.0;  // the path's moment; no animation has one
}

void Ui::move_camera() {
  pose_known_ = true;
  leave_path();
  pose_.put_into(state_.frame);
}

void Ui::show_camera(const std::string& label) {
  state_.frame.eye.clear();
  state_.frame.target.clear();
  state_.frame.fov_deg = FrameOptions().fov_deg;
  state_.frame.camera = label;
  leave_path();
  pose_known_ = false;
}

void Ui::next_camera() {
  const auto& all = facts_->cameras;
  if (all.empty()) return say(false, "the scene has no camera");
  const auto at = std::find(all.begin(), all.end(), state_.frame.camera);
  show_camera(at == all.end() || at + 1 == all.end() ? all.front() : at[1]);
}

void Ui::set_side(const SideState& side) {
  const size_t i = static_cast<size_t>(state_.active);
  state_.sides[i] = side;
  options_[i] = side.make();
}

void Ui::next_preset() {
  const SideState& side = state_.sides[static_cast<size_t>(state_.active)];
  const std::vector<std::string> presets = make_technique(side.technique)->presets();
  std::vector<SideState> all{SideState::of(side.technique)};
  for (const std::string& preset : presets) all.push_back(SideState::of(side.technique, preset));
  const auto at = std::find(all.begin(), all.end(), side);
  const size_t next = at == all.end() ? 0 : size_t(at - all.begin() + 1) % all.size();
  set_side(all[next]);
  say(false, "preset: " + (next == 0 ? std::string("defaults") : presets[next - 1]));
}

void Ui::next_technique() {
  const std::vector<std::string> names = technique_names();
  const auto at = std::find(names.begin(), names.end(), state_.sides[static_cast<size_t>(state_.active)].technique);
  set_side(SideState::of(at == names.end() || at + 1 == names.end() ? names.front() : at[1]));
}

void Ui::toggle_samples() {
  SideState side = state_.sides[static_cast<size_t>(state_.active)];
  if (!side.options.contains("spp")) return say(false, "this technique has no samples to choose");
  side.options["spp"] = side.options["spp"] == "1" ? "32" : "1";
  set_side(side);
}

void Ui::next_compare() {
  state_.compare = static_cast<Compare>((static_cast<int>(state_.compare) + 1) % 4);
}

void Ui::toggle_truth() {
  state_.truth = !state_.truth;
  if (state_.truth && state_.compare == Compare::off) state_.compare = Compare::split;
}

void Ui::step_look(int step) {
  const auto all = looks();
  int at = -1;
  for (size_t i = 0; i < all.size(); ++i)
    if (state_.look == all[i].name) at = static_cast<int>(i);
  const int count = static_cast<int>(all.size()) + 1;  // with the picture
  const int next = (at + 1 + step + count) % count;
  state_.look = next == 0 ? "" : all[static_cast<size_t>(next - 1)].name;
}

void Ui::advance_time(double dt_s) {
  if (!facts_) return;
  if (recorder_) recorder_->add(now_s_, pose_);
  if (replay_start_s_) {
    state_.frame.time_s = std::max(0.0, now_s_ - *replay_start_s_);
    if (state_.frame.time_s >= replay_length_s_) {
      state_.frame.time_s = replay_length_s_;
      replay_start_s_.reset();
    }
  } else if (playing_) {
    const double length = std::max(facts_->animation_length_s, 1e-3);
    state_.frame.time_s = std::fmod(std::max(state_.frame.time_s, 0.0) + std::min(dt_s, 1.0), length);
  }
}

void Ui::step_time(double seconds) {
  if (facts_->animations.empty()) return say(false, "the scene has no animation");
  playing_ = false;
  state_.frame.time_s = std::clamp(std::max(state_.frame.time_s, 0.0) + seconds, 0.0, facts_->animation_length_s);
}

void Ui::take_screenshot() {
  send_request();
  attempt([&] { painter_.screenshot((folder_ / next_file(folder_, "izb", "").filename()).string()); });
}

void Ui::toggle_recording() {
  if (!recorder_) {
    if (!pose_known_) return;
    recorder_.emplace();
    recorder_->add(now_s_, pose_);
    return say(false, "recording the camera: F3 ends it");
  }
  recorder_->end(now_s_, pose_);
  const std::filesystem::path file = next_file(folder_, "izb-path", ".json");
  keep(fmt::format("camera path of {} keys", recorder_->path().keys.size()), file, camera_path_json(recorder_->path()));
  last_path_ = file.string();
  recorder_.reset();
}

void Ui::replay() {
  if (last_path_.empty()) return say(false, "no camera path was recorded: F3 begins one");
  attempt([&] {
    const CameraPath path = read_camera_path(last_path_);
    state_.frame.eye.clear();
    state_.frame.target.clear();
    state_.frame.camera.clear();
    state_.frame.fov_deg = FrameOptions().fov_deg;
    state_.frame.camera_path = last_path_;
    state_.frame.time_s = 0.0;
    replay_length_s_ = path.keys.back().time_s;
    replay_start_s_ = now_s_;
    playing_ = false;
    pose_known_ = false;
  });
}

std::string Ui::command() const {
  const std::string stem = "izb-picture";
  return fmt::format("{} -o {}.exr --preview {}.png", batch_command(state_, state_.active, window_.framebuffer()), stem,
                     stem);
}

void Ui::copy_command() {
  const std::string text = command();
  window_.set_clipboard(text);
  report_.write("command", {{"text", text}});
  say(false, "copied: " + text);
}

// By dump() itself, which throws for a name that is not UTF-8: it would not read back.
void Ui::save_state() {
  attempt([&] { keep("state", folder_ / state_file_, state_.to_json().dump(1) + "\n"); });
}

void Ui::load_state() {
  attempt([&] {
    const std::filesystem::path file = folder_ / state_file_;
    const std::string text = read_text_file(file);
    ViewState state;
    try {
      state = ViewState::from_json(nlohmann::json::parse(text));
    } catch (const nlohmann::json::exception& e) {
      fail("cannot read the state '{}': {}", file.string(), e.what());
    } catch (const Error& e) {
      fail("cannot read the state '{}': {}", file.string(), e.what());
    }
    loading_state_ = {painter_.load(state.scene, state.frame), state};
  });
}

void Ui::drop(const std::string& file) {
  loading_state_.reset();
  painter_.load(file, {});
}

void Ui::export_times() {
  std::string text = "time_s,scale,side,technique,stage,ms\n";
  for (const Timing& timing : timings_)
    for (const StageTime& stage : timing.stages)
      text += fmt::format("{:.3f},{},{},{},{},{:.4f}\n", timing.at_s, timing.scale, timing.side == 0 ? "A" : "B",
                          timing.technique, stage.name, stage.ms);
  if (frame_ && frame_->sides[static_cast<size_t>(state_.active)])
    for (const auto& [name, count] : frame_->sides[static_cast<size_t>(state_.active)]->counts)
      text += fmt::format("{:.3f},1,{},{},count {},{}\n", now_s_, state_.active == 0 ? "A" : "B",
                          state_.sides[static_cast<size_t>(state_.active)].technique, name, count);
  keep("times", next_file(folder_, "izb-times", ".csv"), text);
}

}  // namespace izb
