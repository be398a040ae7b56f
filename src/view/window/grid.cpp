// SPDX-License-Identifier: MIT
// A view of the light-space grid, and picking in it.
#include <imgui.h>

#include <algorithm>

#include "view/window/ui.h"

namespace izb {

namespace {

struct TexelSquare {
  int x, y, side;  ///< lower left texel, and how many
};

/// The square around all texels that have a list, with a margin: with few receivers most of the grid is not used.
TexelSquare used_square(const IzbInternals& built, int layer) {
  glm::ivec2 low(built.grid), high(-1);
  for (int y = 0; y < built.grid; ++y)
    for (int x = 0; x < built.grid; ++x)
      if (!built.lists[built.texel({x, y}, layer)].empty()) {
        low = glm::min(low, glm::ivec2(x, y));
        high = glm::max(high, glm::ivec2(x, y));
      }
  if (high.x < 0) return {0, 0, built.grid};
  const int extent = std::max(high.x - low.x, high.y - low.y) + 1;
  const int side = std::min(extent + extent / 16 + 2, built.grid);
  const glm::ivec2 corner = glm::clamp((low + high - side) / 2, glm::ivec2(0), glm::ivec2(built.grid - side));
  return {corner.x, corner.y, side};
}

}  // namespace

void Ui::draw_grid_window() {
  const Look* look = state_.look.empty() ? nullptr : find_look(state_.look);
  if (!look || !look->of_grid || !facts_) return;
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  const float side = std::min({40.0f * ImGui::GetFontSize(), 0.36f * size.x, 0.75f * size.y});
  ImGui::SetNextWindowPos({size.x - side - 32.0f, 36.0f}, ImGuiCond_FirstUseEver);
  bool is_open = true;
  if (ImGui::Begin("Light-space grid", &is_open, ImGuiWindowFlags_AlwaysAutoResize)) {
    const bool there = look_ && frame_ && frame_->look && frame_->state.look == state_.look && frame_->light_space;
    if (!there) {
      ImGui::TextUnformatted("is made when the picture is at rest");
    } else {
      const Snapshot& s = *frame_->light_space;
      const int layers = s.built ? s.built->layers : 1;
      state_.layer = std::clamp(state_.layer, 0, layers - 1);
      ImGui::Text("%s: %s to %s", look->name, frame_->look->low.c_str(), frame_->look->high.c_str());
      if (layers > 1) {
        ImGui::SetNextItemWidth(160.0f);
        ImGui::SliderInt("layer", &state_.layer, 0, layers - 1);
      }
      const int texels = look_.picture().width_px;
      if (grid_shown_.first.lock() != frame_->light_space || grid_shown_.second != state_.layer) {
        grid_shown_ = {frame_->light_space, state_.layer};
        const TexelSquare used = s.built ? used_square(*s.built, state_.layer) : TexelSquare{0, 0, texels};
        grid_square_ = {used.x, used.y, used.side};
      }
      const glm::ivec3 square = grid_square_;
      const auto uv = [&](int x, int y) {
        return ImVec2(static_cast<float>(x) / static_cast<float>(texels),
                      1.0f - static_cast<float>(y) / static_cast<float>(texels));
      };
      const ImVec2 at = ImGui::GetCursorScreenPos();
      ImGui::Image(look_.id(), {side, side}, uv(square.x, square.y + square.z), uv(square.x + square.z, square.y));
      mark("grid");
      const bool hovered = ImGui::IsItemHovered();
      ImGui::TextDisabled("texels %d, %d to %d, %d of %d x %d", square.x, square.y, square.x + square.z - 1,
                          square.y + square.z - 1, texels, texels);
      ImDrawList* list = ImGui::GetWindowDrawList();
      const float texel_px = side / static_cast<float>(square.z);
      for (const auto& [layer, texel] : lit_texels_) {
        if (layer != state_.layer) continue;
        const ImVec2 corner(at.x + static_cast<float>(texel.x - square.x) * texel_px,
                            at.y + static_cast<float>(square.y + square.z - 1 - texel.y) * texel_px);
        const float reach = std::max(3.0f - texel_px, 0.0f);
        list->AddRect({corner.x - reach, corner.y - reach}, {corner.x + texel_px + reach, corner.y + texel_px + reach},
                      IM_COL32(90, 255, 120, 255));
      }
      if (hovered) {
        const ImVec2 mouse = ImGui::GetIO().MousePos;
        const auto texel_at = [&](float offset) {
          return std::clamp(static_cast<int>(offset / texel_px), 0, square.z - 1);
        };
        const glm::ivec2 texel(square.x + texel_at(mouse.x - at.x), square.y + square.z - 1 - texel_at(mouse.y - at.y));
        if (s.built)
          ImGui::SetTooltip("texel %d, %d: a list of %zu nodes\nclick lights its pixels up", texel.x, texel.y,
                            s.built->lists[s.built->texel(texel, state_.layer)].size());
        if (ImGui::IsMouseClicked(0)) pick_texel(texel);
      }
    }
  }
  ImGui::End();
  if (!is_open) state_.look.clear();
}

void Ui::pick_texel(const glm::ivec2& texel) {
  const Snapshot& s = *frame_->light_space;
  if (!s.built || state_.layer >= s.built->layers) return;
  // A click that misses by little finds the longest list nearby.
  glm::ivec2 best = texel;
  size_t longest = s.built->lists[s.built->texel(texel, state_.layer)].size();
  for (int y = -2; longest == 0 && y <= 2; ++y)
    for (int x = -2; x <= 2; ++x) {
      const glm::ivec2 t = texel + glm::ivec2(x, y);
      if (t.x < 0 || t.y < 0 || t.x >= s.built->grid || t.y >= s.built->grid) continue;
      const size_t length = s.built->lists[s.built->texel(t, state_.layer)].size();
      if (length > longest) longest = length, best = t;
    }
  lit_points_ws_.clear();
  lit_texels_ = {{state_.layer, best}};
  const std::vector<glm::ivec2> pixels = pixels_of_texel(s, best, state_.layer);
  for (const glm::ivec2& px : pixels)
    lit_points_ws_.push_back(point_of_pixel(s.camera_ws, s.width_px, s.height_px, glm::dvec2(px) + 0.5,
                                            double(s.gbuffer.eye_distance[s.index(px)])));
  report_.write("picked", {{"texel", {best.x, best.y}}, {"layer", state_.layer}, {"pixels", pixels.size()}});
}

}  // namespace izb
