// SPDX-License-Identifier: MIT
// The lens, and one pixel in full: its samples, its micro-quad, and the edges that decided.
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "view/window/ui.h"

namespace izb {
namespace {

constexpr unsigned lit_color = IM_COL32(255, 225, 110, 255), shadowed_color = IM_COL32(40, 60, 150, 255),
                   outline = IM_COL32(0, 0, 0, 220);
constexpr unsigned edge_colors[] = {IM_COL32(255, 90, 80, 255), IM_COL32(90, 230, 110, 255),
                                    IM_COL32(90, 180, 255, 255), IM_COL32(240, 120, 240, 255),
                                    IM_COL32(240, 170, 60, 255)};

/// Where f0 + o.x fx + o.y fy = 0 meets the pixel's square, in offsets; false: nowhere.
bool clip_to_pixel(const glm::dvec3& line, glm::dvec2& a, glm::dvec2& b) {
  std::vector<glm::dvec2> hits;
  for (const double s : {-0.5, 0.5}) {
    if (line.z != 0.0)
      if (const double y = -(line.x + s * line.y) / line.z; std::abs(y) <= 0.5) hits.push_back({s, y});
    if (line.y != 0.0)
      if (const double x = -(line.x + s * line.z) / line.y; std::abs(x) <= 0.5) hits.push_back({x, s});
  }
  if (hits.size() < 2) return false;
  a = hits[0];
  b = hits[1];
  for (const glm::dvec2& h : hits)
    if (glm::distance(h, a) > glm::distance(b, a)) b = h;
  return glm::distance(a, b) > 1e-9;
}

void draw_edges(ImDrawList* list, const ProbedPixel& pixel, const ImVec2& corner, float side_px) {
  const auto at = [&](const glm::dvec2& o) {
    return ImVec2(corner.x + static_cast<float>(0.5 + o.x) * side_px,
                  corner.y + static_cast<float>(0.5 - o.y) * side_px);
  };
  size_t n = 0;
  for (const Occluder& occluder : pixel.occluders) {
    const unsigned color = edge_colors[n++ % std::size(edge_colors)];
    for (size_t k = 0; k < 4; ++k) {
      glm::dvec2 a, b;
      if (clip_to_pixel(occluder.lines[k], a, b)) list->AddLine(at(a), at(b), color, k == 3 ? 1.0f : 2.0f);
    }
    if (n == 12) break;  // more would hide the samples
  }
}

}  // namespace

// Each pixel's samples where they lie in it: yellow ones are lit, blue ones in shadow.
void Ui::draw_samples(const SidePicture& side, const ImVec2& corner, float side_px, const glm::ivec2& px) {
  if (!frame_->snapshot || side.mask.size() != frame_->snapshot->size()) return;
  const Snapshot& s = *frame_->snapshot;
  if (px.x < 0 || px.y < 0 || px.x >= s.width_px || px.y >= s.height_px) return;
  const size_t i = s.index(px);
  if (!(s.gbuffer.eye_distance[i] > 0.0f)) return;
  ImDrawList* list = ImGui::GetForegroundDrawList();
  if (side.spp != static_cast<int>(s.samples.offsets_px.size())) return;  // those of the other side lie elsewhere
  const float radius = std::max(1.0f, side_px / 28.0f);
  for (size_t n = 0; n < s.samples.offsets_px.size(); ++n) {
    const glm::vec2 o = s.samples.offsets_px[n];
    const ImVec2 at(corner.x + (0.5f + o.x) * side_px, corner.y + (0.5f - o.y) * side_px);
    const bool shadowed = side.mask[i] >> n & 1u;
    list->AddCircleFilled(at, radius + 0.6f, outline, 8);
    list->AddCircleFilled(at, radius, shadowed ? shadowed_color : lit_color, 8);
  }
}

void Ui::draw_lens() {
  if (!state_.lens || !frame_ || over_interface()) return;
  const ImVec2 size = ImGui::GetIO().DisplaySize, mouse = ImGui::GetIO().MousePos;
  if (mouse.x < 0 || mouse.y < 0 || mouse.x >= size.x || mouse.y >= size.y) return;
  int index = state_.active;
  if (state_.compare == Compare::split) index = mouse.x < state_.split * size.x ? 0 : 1;
  if (state_.compare == Compare::flicker && flicker_on_) index = state_.other();
  const PictureTexture& picture = side_pictures_[static_cast<size_t>(index)];
  if (!picture) return;
  const float power = static_cast<float>(state_.lens_power);
  const float half = std::min(0.42f * std::min(size.x, size.y), 160.0f * std::max(1.0f, power / 16.0f));
  // Whole pixels of the full picture, so that samples lie where they belong.
  const float px = size.x / static_cast<float>(frame_->full.width_px);  // of the picture, in the window's coordinates
  const int reach = std::max(1, static_cast<int>(half / (power * px)));
  const glm::ivec2 center(static_cast<int>(mouse.x / px), static_cast<int>(mouse.y / px));
  const float cell = power * px, extent = cell * (2.0f * static_cast<float>(reach) + 1.0f);
  const ImVec2 corner(mouse.x - 0.5f * extent, mouse.y - 0.5f * extent);
  ImDrawList* list = ImGui::GetForegroundDrawList();
  const auto uv = [&](int x, int y) {
    return ImVec2(static_cast<float>(x) / static_cast<float>(frame_->full.width_px),
                  static_cast<float>(y) / static_cast<float>(frame_->full.height_px));
  };
  list->AddImage(picture.id(), corner, {corner.x + extent, corner.y + extent}, uv(center.x - reach, center.y - reach),
                 uv(center.x + reach + 1, center.y + reach + 1));
  const auto& side = frame_->sides[static_cast<size_t>(index)];
  if (state_.lens_power >= 32 && side && frame_->scale == 1.0) {
    for (int y = -reach; y <= reach; ++y)
      for (int x = -reach; x <= reach; ++x)
        draw_samples(*side,
                     {corner.x + cell * static_cast<float>(x + reach), corner.y + cell * static_cast<float>(y + reach)},
                     cell, center + glm::ivec2(x, y));
    if (probed_ && probed_->px == center)
      draw_edges(list, *probed_,
                 {corner.x + cell * static_cast<float>(reach), corner.y + cell * static_cast<float>(reach)}, cell);
    else if (!asked_probe_ || *asked_probe_ != center) {
      asked_probe_ = center;
      painter_.probe(center);
    }
  }
  list->AddRect(corner, {corner.x + extent, corner.y + extent}, IM_COL32(255, 255, 255, 230), 0.0f, 0, 2.0f);
  const ImVec2 middle(corner.x + cell * static_cast<float>(reach), corner.y + cell * static_cast<float>(reach));
  list->AddRect(middle, {middle.x + cell, middle.y + cell}, IM_COL32(255, 255, 255, 160));
  const std::string text = fmt::format("x{}  pixel {}, {}", state_.lens_power, center.x, center.y);
  list->AddText({corner.x + 5, corner.y + 4}, IM_COL32(0, 0, 0, 255), text.c_str());
  list->AddText({corner.x + 4, corner.y + 3}, IM_COL32(255, 255, 255, 255), text.c_str());
}

void Ui::draw_pixel_window() {
  if (!state_.picked) return;
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  const float side = std::min(18.0f * ImGui::GetFontSize(), 0.16f * size.x);
  // Beside the grid's picture, if that is there.
  const Look* look = find_look(state_.look);
  const float x =
      look && look->of_grid ? (panels_ ? 27.0f * ImGui::GetFontSize() : 8.0f) : size.x - 2.0f * side - 48.0f;
  ImGui::SetNextWindowPos({x, 36.0f}, ImGuiCond_Appearing);
  bool is_open = true;
  const bool shown = ImGui::Begin("Pixel", &is_open, ImGuiWindowFlags_AlwaysAutoResize);
  if (!is_open) state_.picked.reset();
  if (!shown || !probed_ || !frame_) {
    if (shown && !probed_) ImGui::TextUnformatted("waits for the picture");
    return ImGui::End();
  }
  const ProbedPixel& pixel = *probed_;
  ImGui::PushTextWrapPos(2.0f * side + 24.0f);
  ImGui::Text("pixel %d, %d: %d of %zu samples in shadow, %u triangles hide some", pixel.px.x, pixel.px.y,
              pixel.samples_px.size() == 1 ? int(pixel.mask != 0) : std::popcount(pixel.mask), pixel.samples_px.size(),
              pixel.counts[0]);
  if (!pixel.receiver) {
    ImGui::TextUnformatted("nothing there receives light");
    ImGui::PopTextWrapPos();
    return ImGui::End();
  }
  ImDrawList* list = ImGui::GetWindowDrawList();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  // Left: the pixel. Each triangle cuts it along its three shadow quads and its own plane.
  list->AddRectFilled(at, {at.x + side, at.y + side}, IM_COL32(90, 90, 96, 255));
  draw_edges(list, pixel, at, side);
  const auto dot = [&](const ImVec2& p, size_t n) {
    const bool shadowed = pixel.samples_px.size() == 1 ? pixel.mask != 0 : (pixel.mask >> n & 1u);
    list->AddCircleFilled(p, 5.0f, outline, 12);
    list->AddCircleFilled(p, 4.0f, shadowed ? shadowed_color : lit_color, 12);
  };
  for (size_t n = 0; n < pixel.samples_px.size(); ++n)
    dot({at.x + (0.5f + pixel.samples_px[n].x) * side, at.y + (0.5f - pixel.samples_px[n].y) * side}, n);
  // Right: the same on the tangent plane, as a person who stands on it would see it.
  const ImVec2 right(at.x + side + 16.0f, at.y);
  list->AddRectFilled(right, {right.x + side, right.y + side}, IM_COL32(50, 50, 56, 255));
  double reach = 1e-9;
  for (const glm::dvec2& c : pixel.micro_quad_tangent) reach = std::max({reach, std::abs(c.x), std::abs(c.y)});
  const auto on_plane = [&](const glm::dvec2& p) {
    return ImVec2(right.x + side * static_cast<float>(0.5 + 0.45 * p.x / reach),
                  right.y + side * static_cast<float>(0.5 - 0.45 * p.y / reach));
  };
  ImVec2 quad[4];
  for (size_t k = 0; k < 4; ++k) quad[k] = on_plane(pixel.micro_quad_tangent[k]);
  list->AddConvexPolyFilled(quad, 4, IM_COL32(90, 90, 96, 255));
  list->AddPolyline(quad, 4, IM_COL32(255, 255, 255, 255), ImDrawFlags_Closed, 1.0f);
  for (size_t n = 0; n < pixel.samples_tangent.size(); ++n) dot(on_plane(pixel.samples_tangent[n]), n);
  ImGui::Dummy({2.0f * side + 16.0f, side});
  ImGui::Text("left: the pixel; right: its micro-quad on the tangent plane, %.1f pixels across", 2.0 * reach);
  ImGui::Text("in %zu lists of the light-space grid", pixel.texels.size());
  size_t n = 0;
  for (const Occluder& occluder : pixel.occluders) {
    if (n == 8) {
      ImGui::Text("and %zu more", pixel.occluders.size() - n);
      break;
    }
    ImGui::TextColored(ImGui::ColorConvertU32ToFloat4(edge_colors[n % std::size(edge_colors)]),
                       "triangle %u hides %d samples", occluder.triangle,
                       pixel.samples_px.size() == 1 ? 1 : std::popcount(occluder.bits));
    ++n;
  }
  ImGui::PopTextWrapPos();
  ImGui::End();
}

}  // namespace izb
