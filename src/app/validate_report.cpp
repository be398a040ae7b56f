// SPDX-License-Identifier: MIT
#include "app/validate_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "base/json_text.h"
#include "base/table.h"

namespace izb {
namespace {

/// One number of a report, by the path of its keys; empty where the report does not have it.
struct Shown {
  const char* heading;
  const char* path;
};

}  // namespace

nlohmann::json settled_json(const reference::Settled& settled) {
  return {{"compared", settled.compared},
          {"lit", settled.lit},
          {"shadowed", settled.shadowed},
          {"disputed", settled.disputed},
          {"settled_ours", settled.settled_ours},
          {"explained", settled.explained},
          {"explained_by_alpha", settled.explained_by_alpha},
          {"unexplained", settled.unexplained},
          {"leaks", settled.leaks},
          {"false_shadow", settled.false_shadow},
          {"left_out", {{"sky", settled.sky}, {"culled", settled.culled}, {"outside_cone", settled.outside_cone}}}};
}

nlohmann::json points_json(const reference::PointCheck& check) {
  return {{"checked", check.checked},
          {"ok", check.ok},
          {"near_edge", check.near_edge},
          {"depth_tie", check.depth_tie},
          {"near_cutoff", check.near_cutoff},
          {"wrong", check.wrong},
          {"max_plane_ulps", check.max_plane_ulps},
          {"max_ray_offset_px", check.max_ray_offset_px},
          {"lifted", check.lifted},
          {"max_lift_px", check.max_lift_px}};
}

nlohmann::json attribution_json(const reference::Attribution& sums) {
  return {{"table", sums.table},
          {"insertion_leaks", sums.insertion_leaks},
          {"insertion_false", sums.insertion_false},
          {"alpha_leaks", sums.alpha_leaks},
          {"alpha_false", sums.alpha_false},
          {"shadowed_bits", sums.shadowed_bits},
          {"leak_percent", sums.leak_percent()},
          {"alpha_percent", sums.alpha_percent()}};
}

nlohmann::json deformation_json(const DeformCheck& check) {
  return {{"vertices", check.vertices},
          {"wrong", check.wrong},
          {"not_as_on_cpu", check.not_as_on_cpu},
          {"largest_error", check.largest_error}};
}

nlohmann::json model_json(const reference::ModelError& error) {
  return {{"compared", error.compared}, {"differing", error.differing}, {"percent", error.percent()}};
}

nlohmann::json records_json(const reference::Settled& settled, int width_px) {
  nlohmann::json records = nlohmann::json::array();
  for (const reference::DisputedBit& bit : settled.records) {
    if (bit.verdict != reference::Verdict::unexplained || records.size() == 20) break;
    records.push_back({{"x", bit.receiver % width_px},
                       {"y", bit.receiver / width_px},
                       {"sample", bit.sample},
                       {"leak", bit.leak},
                       {"edge_distance_bands", bit.edge_distance_bands}});
  }
  return records;
}

void print_table(const std::vector<SceneReport>& reports) {
  std::vector<Shown> shown{{"pixels", "/pixels"},
                           {"spp", "/spp"},
                           {"shrunk", "/shrunk_pixels"},
                           {"lit", "/lit"},
                           {"shadowed", "/shadowed"},
                           {"disputed", "/disputed"},
                           {"settled_ours", "/settled_ours"},
                           {"explained", "/explained"},
                           {"by alpha", "/explained_by_alpha"},
                           {"unexplained", "/unexplained"},
                           {"leaks", "/leaks"},
                           {"false_shadow", "/false_shadow"},
                           {"sky", "/left_out/sky"},
                           {"culled", "/left_out/culled"},
                           {"outside cone", "/left_out/outside_cone"},
                           {"points wrong", "/points/wrong"}};
  // Columns that only some runs have.
  for (const Shown& more : std::initializer_list<Shown>{{"table", "/attribution/table"},
                                                        {"insertion leaks", "/attribution/insertion_leaks"},
                                                        {"insertion false", "/attribution/insertion_false"},
                                                        {"leak %", "/attribution/leak_percent"},
                                                        {"alpha leaks", "/attribution/alpha_leaks"},
                                                        {"alpha false", "/attribution/alpha_false"},
                                                        {"alpha %", "/attribution/alpha_percent"},
                                                        {"model %", "/model/percent"},
                                                        {"vertices wrong", "/deformation/wrong"}})
    if (std::any_of(reports.begin(), reports.end(), [&](const SceneReport& report) {
          return report.json.contains(nlohmann::json::json_pointer(more.path));
        }))
      shown.push_back(more);
  std::vector<Column> columns{{"scene", Align::left}};
  for (const Shown& column : shown) columns.push_back({column.heading});
  Table table(columns);
  for (const SceneReport& report : reports) {
    std::vector<std::string> row{report.label};
    for (const Shown& column : shown) {
      const nlohmann::json value = report.json.value(nlohmann::json::json_pointer(column.path), nlohmann::json());
      row.push_back(value.is_null()           ? ""
                    : value.is_number_float() ? fmt::format("{:.4f}", value.get<double>())
                                              : json_text(value));
    }
    table.add_row(row);
  }
  fmt::print("{}", table.str());
}

}  // namespace izb
