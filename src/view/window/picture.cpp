// SPDX-License-Identifier: MIT
// The picture, what is compared, and what lies on it.
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "view/window/ui.h"

namespace izb {
namespace {

constexpr unsigned white = IM_COL32(255, 255, 255, 255), black = IM_COL32(0, 0, 0, 200);

/// Text that is read on any ground.
void text_on(ImDrawList* list, ImVec2 at, const std::string& text, unsigned color = white) {
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  list->AddRectFilled({at.x - 4, at.y - 2}, {at.x + size.x + 4, at.y + size.y + 2}, IM_COL32(0, 0, 0, 140), 3.0f);
  list->AddText(at, color, text.c_str());
}

}  // namespace

void Ui::draw_picture() {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImDrawList* list = ImGui::GetBackgroundDrawList();
  if (!facts_ || !frame_) {
    const float share = painter_.loading();
    const std::string text = share >= 0.0f ? fmt::format("loading {} ... {:.0f} %", state_.scene, 100.0f * share)
                             : facts_ || painter_.busy() ? "the first picture is being made"
                                                         : "drop a .glb or .gltf file here";
    return text_on(list, {0.5f * size.x - 0.5f * ImGui::CalcTextSize(text.c_str()).x, 0.5f * size.y}, text);
  }
  const Look* look = state_.look.empty() ? nullptr : find_look(state_.look);
  if (look && !look->of_grid && look_ && frame_->look && frame_->state.look == state_.look) {
    list->AddImage(look_.id(), {0, 0}, size);
    return;
  }
  const bool flicker = state_.compare == Compare::flicker;
  flicker_on_ = flicker && std::fmod(now_s_, 1.0) >= 0.5;
  if (state_.compare == Compare::difference && difference_) {
    list->AddImage(difference_.id(), {0, 0}, size);
    text_on(list, {0.5f * size.x - 180.0f, 8.0f},
            fmt::format("orange: lit in {} alone   blue: lit in {} alone", state_.active == 0 ? "A" : "B",
                        state_.active == 0 ? "B" : "A"));
  } else if (state_.compare == Compare::split) {
    const float bar = std::round(static_cast<float>(state_.split) * size.x);
    draw_side(0, 0.0f, bar);
    draw_side(1, bar, size.x);
    draw_split_bar();
  } else {
    draw_side(flicker_on_ ? state_.other() : state_.active, 0.0f, size.x);
  }
}

void Ui::draw_side(int index, float x0, float x1) {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  if (x1 <= x0) return;
  ImDrawList* list = ImGui::GetBackgroundDrawList();
  const auto& side = frame_->sides[static_cast<size_t>(index)];
  const PictureTexture& picture = side_pictures_[static_cast<size_t>(index)];
  const char* name = index == 0 ? "A" : "B";
  const float label_x = index == 0 ? x0 + (panels_ ? 0.0f : 8.0f) : std::max(x0 + 8.0f, x1 - 260.0f);
  if (picture)
    list->AddImage(picture.id(), {x0, 0}, {x1, size.y}, {x0 / size.x, 0}, {x1 / size.x, 1});
  else
    list->AddRectFilled({x0, 0}, {x1, size.y}, IM_COL32(40, 40, 44, 255));
  if (side && !side->error.empty()) {
    ImGui::GetBackgroundDrawList()->AddText(ImGui::GetFont(), ImGui::GetFontSize(), {x0 + 12, 0.4f * size.y},
                                            IM_COL32(255, 130, 110, 255), side->error.c_str(), nullptr,
                                            std::max(x1 - x0 - 24.0f, 50.0f));
  } else if (!picture) {
    const float share = painter_.tracing();
    text_on(
        list, {x0 + 12, 0.4f * size.y},
        share >= 0.0f ? fmt::format("tracing rays: {:.0f} %", 100.0f * share) : "is made when the picture is at rest");
  }
  if (state_.compare != Compare::split && state_.compare != Compare::flicker) return;
  const std::string what = side ? fmt::format("{}: {} {} spp", name, side->technique, side->spp) : name;
  const float middle = 0.5f * (x0 + x1) - 0.5f * ImGui::CalcTextSize(what.c_str()).x;
  text_on(list, {state_.compare == Compare::split ? middle : label_x + 320.0f, size.y - 52.0f}, what,
          index == state_.active ? IM_COL32(255, 214, 120, 255) : white);
}

void Ui::draw_split_bar() {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  const float x = std::round(static_cast<float>(state_.split) * size.x);
  ImDrawList* list = ImGui::GetBackgroundDrawList();
  list->AddLine({x, 0}, {x, size.y}, black, 4.0f);
  list->AddLine({x, 0}, {x, size.y}, white, 2.0f);
  list->AddCircleFilled({x, 0.5f * size.y}, 9.0f, white);
  list->AddTriangleFilled({x - 6, 0.5f * size.y}, {x - 2, 0.5f * size.y - 4}, {x - 2, 0.5f * size.y + 4}, black);
  list->AddTriangleFilled({x + 6, 0.5f * size.y}, {x + 2, 0.5f * size.y + 4}, {x + 2, 0.5f * size.y - 4}, black);
  rects_["split bar"] = {x - 4, 0.5f * size.y - 4, x + 4, 0.5f * size.y + 4};
}

void Ui::draw_overlays() {
  if (!frame_) return;
  if (state_.frusta && frame_->light_space) draw_frusta();
  if (show_light_) draw_light();
  draw_lit_points();
  draw_status();
}

std::optional<ImVec2> Ui::project(const glm::dvec3& p_ws) const {
  const Camera& c = frame_->camera;
  const glm::dvec3 v(glm::inverse(c.world_from_view) * glm::dvec4(p_ws, 1.0));
  const double depth = c.orthographic ? 1.0 : -v.z;
  if (!(depth > 1e-6)) return {};
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  const double half = c.orthographic ? c.ymag : std::tan(0.5 * c.yfov_rad) * depth;
  return ImVec2(static_cast<float>(0.5 * size.x + 0.5 * size.y * v.x / half),
                static_cast<float>(0.5 * size.y - 0.5 * size.y * v.y / half));
}

// Cut where it passes the camera.
void Ui::draw_line_ws(const glm::dvec3& a, const glm::dvec3& b, unsigned color, float width) {
  const Camera& c = frame_->camera;
  const glm::dmat4 view = glm::inverse(c.world_from_view);
  const double za = -(view * glm::dvec4(a, 1.0)).z, zb = -(view * glm::dvec4(b, 1.0)).z;
  const double nearest = c.orthographic ? -1e300 : 1e-4 * facts_->radius_ws;
  if (za <= nearest && zb <= nearest) return;
  glm::dvec3 p = a, q = b;
  if (za < nearest) p = glm::mix(b, a, (zb - nearest) / (zb - za));
  if (zb < nearest) q = glm::mix(a, b, (za - nearest) / (za - zb));
  const auto from = project(p), to = project(q);
  if (from && to) ImGui::GetBackgroundDrawList()->AddLine(*from, *to, color, width);
}

void Ui::draw_frusta() {
  constexpr unsigned colors[] = {IM_COL32(255, 120, 90, 255),  IM_COL32(120, 220, 120, 255),
                                 IM_COL32(110, 170, 255, 255), IM_COL32(240, 210, 90, 255),
                                 IM_COL32(220, 130, 230, 255), IM_COL32(110, 230, 230, 255)};
  const auto frusta = cascade_frusta_ws(*frame_->light_space);
  for (size_t i = 0; i < frusta.size(); ++i)
    for (int k = 0; k < 8; ++k)
      for (const int bit : {1, 2, 4})
        if (!(k & bit))
          draw_line_ws(frusta[i][static_cast<size_t>(k)], frusta[i][static_cast<size_t>(k | bit)],
                       colors[i % std::size(colors)], 1.5f);
}

// Its way through the focus, or the line to it.
void Ui::draw_light() {
  constexpr unsigned sun_color = IM_COL32(255, 220, 90, 255);
  for (size_t i = 0; i < frame_->lights.size(); ++i) {
    Light light = frame_->lights[i];
    if (moved_light_ && moved_light_->first == i) light = moved_light_->second;
    const float width = static_cast<int>(i) == state_.active_light ? 3.0f : 1.5f;
    if (light.type != LightType::directional) {
      draw_line_ws(light.position_ws, pose_.target_ws, sun_color, width);
      if (const auto at = project(light.position_ws))
        ImGui::GetBackgroundDrawList()->AddCircleFilled(*at, 4.0f + width, sun_color);
      continue;
    }
    const double length = 0.35 * pose_.distance();
    const glm::dvec3 tip = pose_.target_ws, tail = tip - length * light.direction_ws;
    draw_line_ws(tail, tip, sun_color, width);
    const glm::dvec3 side = glm::normalize(glm::cross(light.direction_ws, pose_.forward() + glm::dvec3(1e-6, 0, 0)));
    for (const double s : {1.0, -1.0})
      draw_line_ws(tip, tip - 0.15 * length * light.direction_ws + s * 0.06 * length * side, sun_color, width);
    if (const auto at = project(tail)) ImGui::GetBackgroundDrawList()->AddCircleFilled(*at, 6.0f, sun_color);
  }
}

void Ui::draw_lit_points() {
  constexpr unsigned color = IM_COL32(90, 255, 120, 255);
  for (const glm::dvec3& p : lit_points_ws_)
    if (const auto at = project(p))
      ImGui::GetBackgroundDrawList()->AddRectFilled({at->x - 1.5f, at->y - 1.5f}, {at->x + 1.5f, at->y + 1.5f}, color);
}

void Ui::draw_status() {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  std::string text;
  double ms = 0.0;
  for (const auto& side : frame_->sides)
    if (side) ms += side->frame_ms;
  const auto& side = frame_->sides[static_cast<size_t>(state_.active)];
  if (side) text += fmt::format("{} {} spp  ", side->technique, side->spp);
  text += fmt::format("{} x {}", frame_->full.width_px, frame_->full.height_px);
  if (frame_->scale < 1.0) text += fmt::format(" at {:.0f} %", 100.0 * frame_->scale);
  text += fmt::format("  {:.0f} ms", ms);
  if (frame_->serial != serial_ || (frame_->scale < 1.0 && painter_.busy())) text += "  painting ...";
  if (painter_.tracing() >= 0.0f) text += fmt::format("  rays {:.0f} %", 100.0f * painter_.tracing());
  if (state_.frozen) text += "  light space frozen";
  if (recorder_) text += "  recording";
  if (!state_.look.empty()) {
    text = state_.look + "  " + text;
    if (frame_->look && !frame_->look->high.empty()) text += "  " + frame_->look->low + " to " + frame_->look->high;
  }
  const ImVec2 extent = ImGui::CalcTextSize(text.c_str());
  text_on(ImGui::GetBackgroundDrawList(), {size.x - extent.x - 10.0f, size.y - extent.y - 8.0f}, text);
}

}  // namespace izb
