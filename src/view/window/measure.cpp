// SPDX-License-Identifier: MIT
// What the stages took over the last seconds, and the counts of the paper's table 1.
#include <imgui.h>

#include <algorithm>

#include "frame/spine.h"
#include "view/window/ui.h"

namespace izb {
namespace {

constexpr double graph_s = 10.0;
constexpr unsigned stage_colors[] = {IM_COL32(92, 152, 224, 255), IM_COL32(110, 190, 140, 255),
                                     IM_COL32(226, 196, 92, 255), IM_COL32(190, 130, 210, 255),
                                     IM_COL32(228, 116, 90, 255), IM_COL32(150, 150, 158, 255),
                                     IM_COL32(120, 200, 210, 255)};

/// The stage's place in the spine; what stands before it (deform) comes last.
size_t place_of(const std::string& stage) {
  for (int i = 0; i < static_cast<int>(stage_names.size()); ++i)
    if (stage == name(static_cast<Stage>(i))) return static_cast<size_t>(i);
  return stage_names.size();
}

unsigned color_of(const std::string& stage) {
  return stage_colors[std::min(place_of(stage), std::size(stage_colors) - 1)];
}

double sum_of(const std::vector<StageTime>& stages) {
  double sum = 0.0;
  for (const StageTime& s : stages) sum += s.ms;
  return sum;
}

}  // namespace

// A bar for each frame, where it was finished.
void Ui::draw_graph() {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const ImVec2 size(ImGui::GetContentRegionAvail().x, 6.0f * ImGui::GetFontSize());
  ImDrawList* list = ImGui::GetWindowDrawList();
  list->AddRectFilled(at, {at.x + size.x, at.y + size.y}, IM_COL32(20, 20, 24, 255));
  double highest = 1.0;
  for (const Timing& t : timings_)
    if (t.side == state_.active && t.at_s > now_s_ - graph_s) highest = std::max(highest, sum_of(t.stages));
  for (const Timing& t : timings_) {
    if (t.side != state_.active || t.at_s < now_s_ - graph_s) continue;
    const float x = at.x + size.x * static_cast<float>(1.0 - (now_s_ - t.at_s) / graph_s);
    float y = at.y + size.y;
    for (const StageTime& s : t.stages) {
      const float height = size.y * static_cast<float>(s.ms / highest);
      list->AddRectFilled({x - 2.0f, y - height}, {x + 1.0f, y}, color_of(s.name));
      y -= height;
    }
  }
  ImGui::Dummy(size);
  ImGui::Text("last %.0f s, up to %.1f ms", graph_s, highest);
}

void Ui::measure_panel() {
  if (!ImGui::CollapsingHeader("Measure")) return mark("Measure");
  mark("Measure");
  draw_graph();
  const auto last =
      std::find_if(timings_.rbegin(), timings_.rend(), [&](const Timing& t) { return t.side == state_.active; });
  if (last != timings_.rend()) {
    ImGui::Text("%s, %s", last->technique.c_str(), painter_.slow() ? "by the wall clock" : "by timer queries");
    for (const StageTime& s : last->stages) {
      ImGui::TextColored(ImGui::ColorConvertU32ToFloat4(color_of(s.name)), "%-11s %8.2f ms", s.name.c_str(), s.ms);
    }
    ImGui::Text("%-11s %8.2f ms at %.0f %%", "sum", sum_of(last->stages), 100.0 * last->scale);
  }
  ImGui::Checkbox("counts of table 1", &counts_);
  mark("counts");
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("at rest, by frames of their own");
  const auto& side = frame_ ? frame_->sides[static_cast<size_t>(state_.active)] : std::nullopt;
  if (counts_ && side)
    for (const auto& [label, count] : side->counts)
      ImGui::Text("%-21s %12llu", label.c_str(), static_cast<unsigned long long>(count));
  if (ImGui::Button("export as CSV")) export_times();
  mark("export as CSV");
}

}  // namespace izb
