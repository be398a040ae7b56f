// SPDX-License-Identifier: MIT
// What tells a person what to do: help, hints, messages, and the shaders' flag.
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

#include "view/window/ui.h"

namespace izb {
namespace {

constexpr const char* key_table[][2] = {
    {"left drag", "orbit around the focus"},
    {"right drag; W A S D, Q E", "look around; fly, Q down and E up"},
    {"middle drag, Shift + left drag", "move sideways"},
    {"scroll", "nearer, farther; with the right button held: faster, slower"},
    {"double click", "focus on that point"},
    {"click", "pick a pixel, or on the grid's picture a texel"},
    {"Home, N", "the first camera; the scene's next camera"},
    {"L + drag, L + scroll", "turn the sun, move the lamp"},
    {"K", "the next light is the one that L moves"},
    {"1", "32 samples a pixel, or one"},
    {"P, T", "next preset, next technique, of the active side"},
    {"C", "compare: off, split, flicker, difference"},
    {"X", "the other side becomes the active one"},
    {"R", "the ray-traced truth as the other side"},
    {"V, Shift + V", "next, previous view of a stage"},
    {"G", "freeze the light space while the camera moves on"},
    {"Z", "lens; scroll with it: x2 to x32 (at x32 dots are samples)"},
    {"Space, comma, full stop", "play or pause; a thirtieth of a second back, on"},
    {"F2", "screenshot: PNG, OpenEXR and JSON"},
    {"F3, F4", "record a camera path or end that; replay it"},
    {"F5", "read the shaders again"},
    {"Ctrl + C", "copy the izb render command of this picture"},
    {"Ctrl + S, Ctrl + O", "save, load the whole state"},
    {"Tab, F1, Esc", "hide the panels; this help; close what lies above the picture"},
};

constexpr const char* hints[] = {
    "Drag to look around, scroll to come nearer. The picture sharpens when you stop.",
    "Hold L and drag: the sun turns, and each shadow edge stays sharp at any distance.",
    "Press C for a split bar between two techniques, R for the ray-traced truth beside them.",
    "Press Z and scroll: at x32 a lens shows each pixel's 32 samples, lit or in shadow.",
    "Press V to walk through the pipeline: each stage of the irregular z-buffer has a view.",
};

}  // namespace

void Ui::draw_help() {
  if (!help_) return;
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({0.5f * size.x, 0.5f * size.y}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::SetNextWindowSizeConstraints({0, 0}, {0.96f * size.x, 0.96f * size.y});
  if (ImGui::Begin("Keys and mouse", &help_, ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoCollapse) &&
      ImGui::BeginTable("keys", 2, ImGuiTableFlags_RowBg)) {
    for (const auto& [key, what] : key_table) {
      ImGui::TableNextRow();
      ImGui::TableNextColumn();
      ImGui::TextColored({1.0f, 0.85f, 0.5f, 1.0f}, "%s", key);
      ImGui::TableNextColumn();
      ImGui::TextUnformatted(what);
    }
    ImGui::EndTable();
    if (ImGui::Button("close")) help_ = false;
    mark("close help");
  }
  ImGui::End();
}

void Ui::draw_hints() {
  if (!hints_ || help_ || !facts_) return;
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({0.5f * size.x + 0.12f * size.x, 0.5f * size.y}, ImGuiCond_Appearing, {0.5f, 0.5f});
  if (ImGui::Begin("Five hints", &hints_, ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoCollapse)) {
    ImGui::PushTextWrapPos(std::min(34.0f * ImGui::GetFontSize(), 0.8f * size.x));
    for (const char* hint : hints) ImGui::BulletText("%s", ""), ImGui::SameLine(), ImGui::TextUnformatted(hint);
    ImGui::PopTextWrapPos();
    if (ImGui::Button("close")) hints_ = false;
    mark("close hints");
    ImGui::SameLine();
    if (ImGui::Button("do not show them again")) {
      hints_ = false;
      attempt([&] { write_settings(settings_file_, {.hints = false}); });
    }
    mark("do not show them again");
  }
  ImGui::End();
}

void Ui::draw_toasts() {
  while (!toasts_.empty() && toasts_.front().until_s < now_s_) toasts_.pop_front();
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  float y = size.y - 36.0f;
  size_t n = 0;
  for (auto toast = toasts_.rbegin(); toast != toasts_.rend(); ++toast, ++n) {
    ImGui::SetNextWindowPos({size.x - 10.0f, y}, ImGuiCond_Always, {1.0f, 1.0f});
    ImGui::SetNextWindowSizeConstraints({0, 0}, {0.6f * size.x, 0.5f * size.y});
    ImGui::Begin(fmt::format("##toast{}", n).c_str(), nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoInputs |
                     ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav);
    ImGui::PushTextWrapPos(std::min(44.0f * ImGui::GetFontSize(), 0.58f * size.x));
    if (toast->message.error)
      ImGui::TextColored({1.0f, 0.55f, 0.45f, 1.0f}, "%s", toast->message.text.c_str());
    else
      ImGui::TextUnformatted(toast->message.text.c_str());
    ImGui::PopTextWrapPos();
    y -= ImGui::GetWindowHeight() + 4.0f;
    ImGui::End();
  }
}

// White: as the program began; green: read again; red: refused, and what the compiler said.
void Ui::draw_flag() {
  constexpr unsigned colors[] = {IM_COL32(235, 235, 235, 255), IM_COL32(80, 210, 100, 255), IM_COL32(235, 70, 60, 255)};
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  const float side = ImGui::GetFontSize();
  ImDrawList* list = ImGui::GetBackgroundDrawList();
  const ImVec2 at(size.x - side - 10.0f, 10.0f);
  list->AddLine(at, {at.x, at.y + 1.6f * side}, IM_COL32(20, 20, 20, 255), 2.0f);
  list->AddTriangleFilled(at, {at.x + side, at.y + 0.4f * side}, {at.x, at.y + 0.8f * side}, colors[flag_.color]);
  rects_["flag"] = {at.x, at.y, at.x + side, at.y + side};
  if (flag_.color != ShaderFlag::red) return;
  ImGui::SetNextWindowPos({size.x - 2.0f * side - 16.0f, 8.0f}, ImGuiCond_Always, {1.0f, 0.0f});
  ImGui::SetNextWindowSizeConstraints({0, 0}, {0.7f * size.x, 0.5f * size.y});
  if (ImGui::Begin("the shaders are not read: the last good ones go on", nullptr,
                   ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoFocusOnAppearing)) {
    ImGui::PushTextWrapPos(0.65f * size.x);
    ImGui::TextColored({1.0f, 0.6f, 0.5f, 1.0f}, "%s", flag_.text.c_str());
    ImGui::PopTextWrapPos();
  }
  ImGui::End();
}

}  // namespace izb
