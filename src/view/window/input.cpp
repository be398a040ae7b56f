// SPDX-License-Identifier: MIT
// Keys and mouse; docs/VIEW.md and the help overlay list them.
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "scene/find.h"
#include "view/window/ui.h"

namespace izb {
namespace {

constexpr double radians_a_unit = 0.006;  // of a drag, in the window's coordinates

bool pressed(int key) {
  return ImGui::IsKeyPressed(key, false);
}

}  // namespace

bool Ui::over_interface() const {
  return ImGui::GetIO().WantCaptureMouse;
}

void Ui::handle_input() {
  handle_keys();
  if (facts_) handle_mouse();
}

void Ui::handle_keys() {
  const ImGuiIO& io = ImGui::GetIO();
  if (io.WantTextInput) return;
  if (io.KeyCtrl) {
    if (pressed('C') && facts_) copy_command();
    if (pressed('S') && facts_) save_state();
    if (pressed('O')) load_state();
    return;
  }
  if (pressed(keys::f1)) help_ = !help_;
  if (pressed(keys::escape)) {
    if (help_)
      help_ = false;
    else if (hints_)
      hints_ = false;
    else if (state_.picked)
      state_.picked.reset();
    else
      state_.lens = false;
    toasts_.clear();
    lit_points_ws_.clear();
    lit_texels_.clear();
  }
  if (!facts_) return;  // what follows is about a scene
  if (pressed(keys::tab)) panels_ = !panels_;
  if (pressed(keys::f2)) take_screenshot();
  if (pressed(keys::f3)) toggle_recording();
  if (pressed(keys::f4)) replay();
  if (pressed(keys::f5)) painter_.reload_shaders();
  if (pressed(keys::home) && !facts_->cameras.empty()) show_camera(facts_->cameras.front());
  if (pressed('1')) toggle_samples();
  if (pressed(' ')) playing_ = !playing_ && !facts_->animations.empty();
  if (pressed(',')) step_time(-1.0 / 30.0);
  if (pressed('.')) step_time(1.0 / 30.0);
  if (pressed('V')) step_look(io.KeyShift ? -1 : 1);
  if (pressed('G')) state_.frozen = !state_.frozen;
  if (pressed('Z')) state_.lens = !state_.lens;
  if (pressed('C')) next_compare();
  if (pressed('X')) state_.active = state_.other();
  if (pressed('R')) toggle_truth();
  if (pressed('P')) next_preset();
  if (pressed('T')) next_technique();
  if (pressed('N')) next_camera();
  if (pressed('K') && frame_ && !frame_->lights.empty())
    state_.active_light = (state_.active_light + 1) % static_cast<int>(frame_->lights.size());
}

void Ui::handle_mouse() {
  const ImGuiIO& io = ImGui::GetIO();
  const bool light_key = !io.WantTextInput && !io.KeyCtrl && ImGui::IsKeyDown('L');
  show_light_ = show_light_ && !light_key;
  const float bar = static_cast<float>(state_.split) * io.DisplaySize.x;
  const bool split = state_.compare == Compare::split;
  if (!over_interface() && ImGui::IsMouseClicked(0)) {
    dragging_bar_ = split && std::abs(io.MousePos.x - bar) < 0.5f * ImGui::GetFontSize();
    dragging_view_ = !dragging_bar_;
  }
  if (!over_interface() && (ImGui::IsMouseClicked(1) || ImGui::IsMouseClicked(2))) dragging_view_ = true;
  if (!ImGui::IsMouseDown(0) && !ImGui::IsMouseDown(1) && !ImGui::IsMouseDown(2))
    dragging_bar_ = dragging_view_ = false;

  if (dragging_bar_) {
    state_.split = std::clamp(double(io.MousePos.x / std::max(io.DisplaySize.x, 1.0f)), 0.0, 1.0);
    return;
  }
  const float dx = io.MouseDelta.x, dy = io.MouseDelta.y;
  if (light_key && dragging_view_ && (dx != 0.0f || dy != 0.0f)) {
    turn_light(dx, dy, 0.0f);
  } else if (dragging_view_ && (dx != 0.0f || dy != 0.0f)) {
    const bool sideways = ImGui::IsMouseDown(2) || (ImGui::IsMouseDown(0) && io.KeyShift);
    if (sideways) {
      const double px = pose_.pixel_ws(static_cast<int>(io.DisplaySize.y));
      pose_.move({-dx * px, dy * px, 0.0});
    } else if (ImGui::IsMouseDown(1)) {
      pose_.look(dx * radians_a_unit, -dy * radians_a_unit);
    } else {
      pose_.orbit(dx * radians_a_unit, -dy * radians_a_unit);
    }
    move_camera();
  }
  if (io.MouseWheel != 0.0f && !over_interface()) {
    if (state_.lens) {
      state_.lens_power = std::clamp(io.MouseWheel > 0.0f ? state_.lens_power * 2 : state_.lens_power / 2, 2, 32);
    } else if (light_key) {
      turn_light(0.0f, 0.0f, io.MouseWheel);
    } else if (ImGui::IsMouseDown(1)) {
      fly_speed_ = std::clamp(fly_speed_ * std::pow(1.25, double(io.MouseWheel)), 1e-3, 1e3);
    } else {
      pose_.approach(std::pow(0.88, double(io.MouseWheel)));
      move_camera();
    }
  }
  if (click_ && now_s_ - click_->first > double(io.MouseDoubleClickTime)) {
    pick(click_->second);
    click_.reset();
  }
  if (over_interface()) return;
  if (ImGui::IsMouseDoubleClicked(0)) {
    click_.reset();
    return focus_on(io.MousePos);
  }
  // A press that went nowhere is a pick; the second of a double click is not.
  const ImVec2 moved = ImGui::GetMouseDragDelta(0, 0.0f);
  if (ImGui::IsMouseReleased(0) && !light_key && std::abs(moved.x) + std::abs(moved.y) < 3.0f &&
      io.MouseDownDurationPrev[0] < 0.5f && io.MouseClickedLastCount[0] == 1)
    pick_later(io.MousePos);
}

void Ui::handle_fly(double dt_s) {
  const ImGuiIO& io = ImGui::GetIO();
  flying_ = false;
  if (!facts_ || io.WantTextInput || io.KeyCtrl || !window_.focused()) return;
  glm::dvec3 way(0.0);
  const auto along = [](int key) { return ImGui::IsKeyDown(key) ? 1.0 : 0.0; };
  way.x = along('D') - along('A');
  way.y = along('E') - along('Q');
  way.z = along('W') - along('S');
  if (way == glm::dvec3(0.0)) return;
  flying_ = true;
  // A frame that took long is no leap.
  const double step = 0.25 * facts_->radius_ws * fly_speed_ * std::min(dt_s, 0.1);
  pose_.move(glm::normalize(way) * step);
  move_camera();
}

void Ui::turn_light(float dx, float dy, float wheel) {
  if (!frame_ || frame_->lights.empty()) return;
  const FrameOptions &its = frame_->state.frame, &mine = state_.frame;
  const auto count = [](const std::string& list) { return list_of(list).size(); };
  if (its.light != mine.light || count(its.sun) != count(mine.sun) || count(its.spot) != count(mine.spot) ||
      count(its.point) != count(mine.point))
    return;  // its lights are others: those that were chosen are not shown yet
  const size_t index = static_cast<size_t>(std::min<int>(state_.active_light, int(frame_->lights.size()) - 1));
  Light light = frame_->lights[index];
  // The picture may be some drags behind: what was asked for last counts.
  if (moved_light_ && moved_light_->first == index) light = moved_light_->second;
  if (light.type == LightType::directional) {
    light.direction_ws = turned(light.direction_ws, dx * radians_a_unit, -dy * radians_a_unit);
  } else {
    const glm::dvec3 to_light = light.position_ws - pose_.eye_ws;
    const double distance = std::max(glm::dot(to_light, pose_.forward()), 0.05 * pose_.distance());
    const double px = pose_.pixel_ws(static_cast<int>(ImGui::GetIO().DisplaySize.y)) * distance / pose_.distance();
    light.position_ws +=
        px * (double(dx) * pose_.right() - double(dy) * pose_.up()) + 0.05 * double(wheel) * distance * pose_.forward();
  }
  moved_light_ = {index, light};
  show_light_ = true;
  put_light(state_.frame, frame_->lights, index, light);
}

void Ui::focus_on(const ImVec2& at) {
  if (!frame_ || !frame_->snapshot) return;
  const Snapshot& s = *frame_->snapshot;
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  const glm::dvec2 px(at.x * float(s.width_px) / size.x, at.y * float(s.height_px) / size.y);
  const glm::ivec2 whole(px);
  if (whole.x < 0 || whole.y < 0 || whole.x >= s.width_px || whole.y >= s.height_px) return;
  const float t = s.gbuffer.eye_distance[s.index(whole)];
  if (!(t > 0.0f)) return say(false, "there is only sky");
  pose_.focus(point_of_pixel(frame_->camera, s.width_px, s.height_px, px, double(t)));
  move_camera();
}

void Ui::pick_later(const ImVec2& at) {
  if (!frame_) return;
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  const glm::ivec2 px(static_cast<int>(at.x * float(frame_->full.width_px) / size.x),
                      static_cast<int>(at.y * float(frame_->full.height_px) / size.y));
  if (px.x >= 0 && px.y >= 0 && px.x < frame_->full.width_px && px.y < frame_->full.height_px) click_ = {now_s_, px};
}

void Ui::pick(const glm::ivec2& px) {
  state_.picked = px;
  lit_points_ws_.clear();
  // The request that brings the lists goes first.
  send_request();
  ask_probe(px);
}

}  // namespace izb
