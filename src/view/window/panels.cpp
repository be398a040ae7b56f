// SPDX-License-Identifier: MIT
// The panels at the left. What techniques offer comes from their option declarations alone.
#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>

#include "base/error.h"
#include "frame/spine.h"
#include "view/window/ui.h"

namespace izb {
namespace {

void tooltip(const std::string& text) {
  if (!ImGui::IsItemHovered()) return;
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(28.0f * ImGui::GetFontSize());
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

}  // namespace

/// Remembers where the widget before is, for scripts.
void Ui::mark(const char* label) {
  if (!report_.on()) return;
  const ImVec2 a = ImGui::GetItemRectMin(), b = ImGui::GetItemRectMax();
  if (ImGui::IsItemVisible()) rects_[label] = {a.x, a.y, b.x, b.y};
}

void Ui::draw_panels() {
  if (report_.on()) {
    const auto bar = rects_.extract("split bar");
    rects_.clear();
    if (!bar.empty() && state_.compare == Compare::split)
      rects_.insert(rects_.find("split bar"), {bar.key(), bar.mapped()});
  }
  if (!panels_ || !facts_) return;
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  const float width = std::min(26.0f * ImGui::GetFontSize(), 0.6f * size.x);
  ImGui::SetNextWindowPos({8.0f, 8.0f}, ImGuiCond_FirstUseEver);
  ImGui::SetNextWindowSize({width, size.y - 16.0f}, ImGuiCond_FirstUseEver);
  if (ImGui::Begin("izb  (F1: help, Tab: hide)")) {
    ImGui::PushItemWidth(-9.5f * ImGui::GetFontSize());
    scene_panel();
    camera_panel();
    light_panel();
    technique_panel();
    compare_panel();
    stages_panel();
    measure_panel();
    keep_panel();
    ImGui::PopItemWidth();
  }
  ImGui::End();
}

void Ui::scene_panel() {
  if (!ImGui::CollapsingHeader("Scene", ImGuiTreeNodeFlags_DefaultOpen)) return mark("Scene");
  mark("Scene");
  ImGui::Text("%s", std::filesystem::path(facts_->file).filename().c_str());
  tooltip(facts_->file);
  ImGui::Text("%zu triangles", facts_->triangles);
  ImGui::TextDisabled("drop a .glb or .gltf file for another");
  if (facts_->animations.empty()) return;
  if (ImGui::Button(playing_ ? "pause" : "play")) playing_ = !playing_;
  mark("play");
  ImGui::SameLine();
  float time_s = static_cast<float>(std::max(state_.frame.time_s, 0.0));
  if (ImGui::SliderFloat("time", &time_s, 0.0f, static_cast<float>(facts_->animation_length_s), "%.2f s"))
    state_.frame.time_s = static_cast<double>(time_s);
  mark("time");
  if (facts_->animations.size() > 1 &&
      ImGui::BeginCombo("animation", state_.frame.animation.empty() ? "the first" : state_.frame.animation.c_str())) {
    for (const std::string& label : facts_->animations)
      if (ImGui::Selectable(label.c_str(), label == state_.frame.animation)) state_.frame.animation = label;
    if (ImGui::Selectable("all", state_.frame.animation == "all")) state_.frame.animation = "all";
    ImGui::EndCombo();
  }
  if (ImGui::Button("at rest")) {
    playing_ = false;
    state_.frame.time_s = -1.0;
    state_.frame.animation.clear();
  }
}

void Ui::camera_panel() {
  if (!ImGui::CollapsingHeader("Camera")) return mark("Camera");
  mark("Camera");
  const bool named = state_.frame.eye.empty() && !state_.frame.camera.empty();
  if (ImGui::BeginCombo("camera", named ? state_.frame.camera.c_str() : "moved by hand")) {
    for (const std::string& label : facts_->cameras)
      if (ImGui::Selectable(label.c_str(), named && label == state_.frame.camera)) show_camera(label);
    ImGui::EndCombo();
  }
  mark("camera");
  float fov = static_cast<float>(pose_.yfov_deg);
  if (ImGui::SliderFloat("field of view", &fov, 5.0f, 120.0f, "%.1f degrees")) {
    pose_.yfov_deg = static_cast<double>(fov);
    move_camera();
  }
  ImGui::Text("eye %.2f %.2f %.2f", pose_.eye_ws.x, pose_.eye_ws.y, pose_.eye_ws.z);
  ImGui::Text("focus at a distance of %.2f", pose_.distance());
  float speed = static_cast<float>(fly_speed_);
  if (ImGui::SliderFloat("speed", &speed, 1e-2f, 1e2f, "%.2f", ImGuiSliderFlags_Logarithmic))
    fly_speed_ = static_cast<double>(speed);
  tooltip("of W A S D Q E; scroll with the right button held does the same");
}

void Ui::light_panel() {
  if (!ImGui::CollapsingHeader("Light")) return mark("Light");
  mark("Light");
  ImGui::TextUnformatted("hold L and drag: turns a sun, moves a lamp");
  if (!facts_->lights.empty() &&
      ImGui::BeginCombo("of the scene", state_.frame.light.empty() ? "none" : state_.frame.light.c_str())) {
    const auto choose = [&](const std::string& label) {
      state_.frame.light = label;
      state_.frame.sun.clear(), state_.frame.spot.clear(), state_.frame.point.clear();
      state_.frame.light_direction.clear(), state_.frame.light_position.clear();
      state_.active_light = 0;
      moved_light_.reset();
    };
    for (const std::string& label : facts_->lights)
      if (ImGui::Selectable(label.c_str(), label == state_.frame.light)) choose(label);
    if (facts_->lights.size() > 1 && ImGui::Selectable("all", state_.frame.light == "all")) choose("all");
    ImGui::EndCombo();
  }
  const auto only = [&](const char* label, const char* help, std::string FrameOptions::*member,
                        const std::string& text) {
    if (ImGui::Button(label)) {
      state_.frame.light.clear(), state_.frame.sun.clear(), state_.frame.spot.clear(), state_.frame.point.clear();
      state_.frame.light_direction.clear(), state_.frame.light_position.clear();
      state_.frame.*member = text;
      state_.active_light = 0;
      moved_light_.reset();
    }
    mark(label);
    tooltip(help);
  };
  const glm::dvec3 above = pose_.target_ws + glm::dvec3(0.0, 0.3 * pose_.distance(), 0.0);
  only("sun", "a directional light", &FrameOptions::sun, "135,40");
  ImGui::SameLine();
  only("lamp", "a light that shines all around, above the focus", &FrameOptions::point, text_of(above));
  ImGui::SameLine();
  only("spot", "a spot light of 30 degrees from the eye to the focus", &FrameOptions::spot,
       fmt::format("{},{},30", text_of(pose_.eye_ws), text_of(pose_.target_ws)));
  if (frame_) {
    for (size_t i = 0; i < frame_->lights.size(); ++i) {
      const Light& light = frame_->lights[i];
      if (ImGui::Selectable(fmt::format("{} ({})##{}", light.name, type_name(light.type), i).c_str(),
                            static_cast<int>(i) == state_.active_light))
        state_.active_light = static_cast<int>(i);
    }
    tooltip("the chosen one is moved by L, and its mask is looked at (K: the next)");
  }
  ImGui::Checkbox("show it", &show_light_);
  mark("show light");
}

void Ui::option_widget(const Option& option) {
  const std::string text = option.unit.empty() ? option.name : fmt::format("{} [{}]", option.name, option.unit);
  const auto set = [&](const std::string& value) { attempt([&] { option.set(value); }); };
  if (bool* const* flag = std::get_if<bool*>(&option.value)) {
    bool value = **flag;
    if (ImGui::Checkbox(text.c_str(), &value)) **flag = value;
  } else if (!option.choices.empty()) {
    const std::string now = option.to_json().get<std::string>();
    if (ImGui::BeginCombo(text.c_str(), now.c_str())) {
      for (const std::string& choice : option.choices)
        if (ImGui::Selectable(choice.c_str(), choice == now)) set(choice);
      ImGui::EndCombo();
    }
  } else if (int* const* integer = std::get_if<int*>(&option.value)) {
    int value = **integer;
    if (ImGui::InputInt(text.c_str(), &value, 1, 100, ImGuiInputTextFlags_EnterReturnsTrue) ||
        ImGui::IsItemDeactivatedAfterEdit())
      set(fmt::format("{}", value));
  } else if (double* const* number = std::get_if<double*>(&option.value)) {
    double value = **number;
    ImGui::InputDouble(text.c_str(), &value, 0.25, 1.0, "%.3f");
    if (value != **number) set(fmt::format("{}", value));
  } else {
    std::string value = *std::get<std::string*>(option.value);
    if (ImGui::InputText(text.c_str(), &value, ImGuiInputTextFlags_EnterReturnsTrue)) set(value);
  }
  mark(option.name.c_str());
  tooltip(option.describe());
}

void Ui::technique_panel() {
  if (!ImGui::CollapsingHeader("Technique", ImGuiTreeNodeFlags_DefaultOpen)) return mark("Technique");
  mark("Technique");
  for (int i = 0; i < 2; ++i) {
    if (i == 1) ImGui::SameLine();
    ImGui::RadioButton(i == 0 ? "side A" : "side B", &state_.active, i);
    mark(i == 0 ? "side A" : "side B");
  }
  const size_t active = static_cast<size_t>(state_.active);
  Technique& technique = *options_[active];
  if (ImGui::BeginCombo("technique", technique.info().name.c_str())) {
    for (const std::string& name : technique_names()) {
      if (ImGui::Selectable(name.c_str(), name == technique.info().name)) set_side(SideState::of(name));
      tooltip(make_technique(name)->info().line);
    }
    ImGui::EndCombo();
    return;  // the options are another's now
  }
  mark("technique");
  const std::vector<std::string> presets = technique.presets();
  if (!presets.empty() && ImGui::BeginCombo("preset", "choose")) {
    if (ImGui::Selectable("defaults")) set_side(SideState::of(technique.info().name));
    for (const std::string& preset : presets)
      if (ImGui::Selectable(preset == "paper" ? "paper (table 1)" : preset.c_str()))
        set_side(SideState::of(state_.sides[active].technique, preset));
    ImGui::EndCombo();
    return;
  }
  mark("preset");
  if (!ImGui::TreeNode("options")) return mark("options");
  mark("options");
  const OptionSet set = options_[active]->options();
  for (const Option& option : set.options()) option_widget(option);
  ImGui::TreePop();
  state_.sides[active].options = set.to_json();
}

void Ui::compare_panel() {
  if (!ImGui::CollapsingHeader("Compare", ImGuiTreeNodeFlags_DefaultOpen)) return mark("Compare");
  mark("Compare");
  int compare = static_cast<int>(state_.compare);
  for (int i = 0; i < 4; ++i) {
    if (i > 0) ImGui::SameLine();
    const char* label = name(static_cast<Compare>(i));
    ImGui::RadioButton(label, &compare, i);
    mark(label);
  }
  state_.compare = static_cast<Compare>(compare);
  bool truth = state_.truth;
  if (ImGui::Checkbox("ray-traced truth as the other side", &truth)) toggle_truth();
  mark("truth");
  ImGui::Checkbox("lens", &state_.lens);
  mark("lens");
  if (state_.lens) {
    ImGui::SameLine();
    int power = 0;
    while ((2 << power) < state_.lens_power) ++power;
    ImGui::SetNextItemWidth(7.0f * ImGui::GetFontSize());
    if (ImGui::SliderInt("##power", &power, 0, 4, fmt::format("x{}", state_.lens_power).c_str()))
      state_.lens_power = 2 << power;
  }
}

void Ui::stages_panel() {
  if (!ImGui::CollapsingHeader("Stages")) return mark("Stages");
  mark("Stages");
  ImGui::Checkbox("cascades as frusta", &state_.frusta);
  mark("frusta");
  ImGui::Checkbox("freeze the light space", &state_.frozen);
  mark("freeze");
  tooltip("the lists stay as they are while the camera moves on: lists and frusta of the moment, seen from elsewhere");
  ImGui::Separator();
  if (ImGui::Selectable("the picture", state_.look.empty())) state_.look.clear();
  mark("the picture");
  for (int i = 0; i < static_cast<int>(stage_names.size()); ++i) {
    const char* stage = izb::name(static_cast<Stage>(i));
    bool titled = false;
    for (const Look& look : looks()) {
      if (std::string_view(look.stage) != stage) continue;
      if (!titled) ImGui::TextDisabled("%s", stage);
      titled = true;
      if (ImGui::Selectable(look.name, state_.look == look.name)) state_.look = look.name;
      mark(look.name);
      tooltip(look.help);
    }
  }
}

void Ui::keep_panel() {
  if (!ImGui::CollapsingHeader("Keep")) return mark("Keep");
  mark("Keep");
  const auto button = [&](const char* label, const char* help, auto&& action) {
    if (ImGui::Button(label)) action();
    mark(label);
    tooltip(help);
  };
  button("screenshot", "PNG, OpenEXR with all channels, JSON (F2)", [&] { take_screenshot(); });
  ImGui::SameLine();
  button("copy command", "the izb render command of this picture (Ctrl C)", [&] { copy_command(); });
  button(recorder_ ? "end recording" : "record path", "of the camera (F3)", [&] { toggle_recording(); });
  ImGui::SameLine();
  button("replay", "the path recorded last (F4)", [&] { replay(); });
  ImGui::InputText("state", state_file_, sizeof state_file_);
  button("save state", "all that the viewer shows, as JSON (Ctrl S)", [&] { save_state(); });
  ImGui::SameLine();
  button("load state", "(Ctrl O)", [&] { load_state(); });
  button("reload shaders", "they are read when a file is saved, too (F5)", [&] { painter_.reload_shaders(); });
  ImGui::TextDisabled("into %s", folder_.c_str());
}

}  // namespace izb
