// SPDX-License-Identifier: MIT
// Table 1: stage times and the work that was done, beside the paper's.
#include "app/bench/report_table.h"
#include "app/bench/sections.h"
#include "base/error.h"
#include "frame/spine.h"

namespace izb::bench {

using nlohmann::json;

namespace {

struct Column {
  const char *label, *ours, *theirs;
  double scale = 1.0;
};

constexpr Column times[] = {{"gbuffer", "stages/gbuffer", "gbuffer"},
                            {"bounds", "stages/bounds", "bounds"},
                            {"build", "stages/build", "build"},
                            {"zcull", "stages/zcull", "zcull"},
                            {"visibility", "stages/visibility", "visibility"},
                            {"shade", "stages/shade", "shade"},
                            {"frame", "frame_ms", "frame"}};

constexpr Column work[] = {{"fragments", "counts/fragments_after_zcull", "fragments_millions", 1e-6},
                           {"tests", "counts/visibility_tests", "tests_millions", 1e-6},
                           {"tests a fragment", "averages/tests_a_fragment", "tests_a_fragment"},
                           {"tests a receiver", "averages/tests_a_receiver", "tests_a_pixel"}};

/// The paper's number for a scene of ours that stands for one of its, or why there is none.
json papers(const json& table, const BenchScene& scene, const char* samples, const char* key) {
  if (!table.contains(scene.procedural)) return no_value("the paper has no such scene");
  return table[scene.procedural][samples][key];
}

/// Ours and theirs in turn. `work_columns`: millions and averages, else milliseconds.
ReportTable make_table(const Evidence& e, const std::string& id, const std::string& caption,
                       const std::string& configuration, const char* samples, std::span<const Column> columns,
                       bool work_columns) {
  std::vector<ReportColumn> header{{.name = "scene", .text = true}, {.name = "triangles", .digits = 0}};
  for (const Column& c : columns) {
    const std::string unit = !work_columns ? "ms" : c.scale != 1.0 ? "millions" : "";
    header.push_back({.name = "ours", .unit = unit, .group = c.label});
    header.push_back({.name = "theirs", .unit = unit, .group = c.label, .paper = true});
  }
  ReportTable table(id, caption, header);
  const json& paper = e.paper["table1"];
  for (const Measured* m : e.jobs) {
    std::vector<json> row{scene_label(*m), m->works() ? m->result["scene"]["triangles"] : no_value(m->reason())};
    for (const Column& c : columns) {
      row.push_back(value(*m, configuration, c.ours, c.scale));
      row.push_back(papers(paper, m->job.scene, samples, c.theirs));
    }
    table.add(std::move(row));
  }
  for (const auto& [name, theirs] : paper.items()) {
    if (name != "building" && name != "epic_citadel") continue;
    std::vector<json> row{theirs["scene"], theirs["triangles"]};
    for (const Column& c : columns) {
      row.push_back(no_value("no scene of ours stands for it"));
      row.push_back(theirs[samples][c.theirs]);
    }
    table.add(std::move(row));
  }
  return table;
}

json stage_plot(const Evidence& e, const std::string& configuration) {
  json plot = new_plot("table1-stages", "stacked", "Where a frame's time goes: " + configuration,
                       {"scene", "", "category"}, {"time", "ms"}, scene_labels(e.jobs));
  for (const Column& c : times) {
    if (std::string(c.label) == "frame") continue;
    std::vector<json> values;
    for (const Measured* m : e.jobs) values.push_back(value(*m, configuration, c.ours));
    plot["series"].push_back(series(c.label, std::move(values)));
  }
  return plot;
}

json tests_plot(const Evidence& e, const std::string& configuration) {
  json plot = new_plot("table1-tests", "bars", "Visibility tests a pixel at 32 samples", {"scene", "", "category"},
                       {"tests a pixel"}, scene_labels(e.jobs));
  std::vector<json> ours, theirs;
  for (const Measured* m : e.jobs) {
    ours.push_back(value(*m, configuration, "averages/tests_a_receiver"));
    theirs.push_back(papers(e.paper["table1"], m->job.scene, "32", "tests_a_pixel"));
  }
  plot["series"].push_back(series("ours", std::move(ours)));
  plot["series"].push_back(series("paper", std::move(theirs), true));
  return plot;
}

ReportTable peer_table(const Evidence& e) {
  ReportTable table("table1-peer",
                    "The same receivers by rays on the same cores: rebuilding the hierarchy and 32 rays a pixel",
                    {{.name = "scene", .text = true},
                     {.name = "32 samples, defaults", .unit = "ms", .group = "izb"},
                     {.name = "32 samples, as in the paper", .unit = "ms", .group = "izb"},
                     {.name = "rebuild", .unit = "ms", .group = "Embree, low quality"},
                     {.name = "trace", .unit = "ms", .group = "Embree, low quality"},
                     {.name = "sum", .unit = "ms", .group = "Embree, low quality"},
                     {.name = "izb defaults / Embree", .digits = 2}});
  for (const Measured* m : e.jobs) {
    const json ours = value(*m, "32 samples, defaults", "shadow_ms");
    std::vector<json> row{scene_label(*m), ours, value(*m, "32 samples, as in the paper", "shadow_ms")};
    const bool traced = m->works() && m->result.contains("peer");
    const std::string reason = m->works() ? "this build has no Embree" : m->reason();
    for (const char* key : {"rebuild_ms", "trace_ms", "sum_ms"})
      row.push_back(traced ? m->result["peer"]["low"][key] : no_value(reason));
    row.push_back(ratio(ours, row.back()));
    table.add(std::move(row));
  }
  return table;
}

}  // namespace

json table1_section(const Evidence& e) {
  json section = new_section(
      "table1", "Table 1: stages and work",
      {"Times of each stage and the work that was done, with the setting of the paper's table 1 (four cascades of 2048 "
       "x 2048, all optimizations of its section 6), beside the paper's own numbers for the scenes after which ours "
       "are named. The paper measured a GeForce GTX 980; its one sample took hardware's conservative raster.",
       "Scenes are namesakes and not copies, so counts agree in kind and not in digits. Compare counts with the "
       "paper's, milliseconds only among ours."});
  const std::string names[] = {"32 samples, as in the paper", "1 sample, as in the paper"};
  const char* samples[] = {"32", "1"};
  for (int i = 0; i < 2; ++i)
    section["tables"].push_back(make_table(e, fmt::format("table1-times-{}", samples[i]), "Stage times, " + names[i],
                                           names[i], samples[i], times, false)
                                    .json());
  for (int i = 0; i < 2; ++i)
    section["tables"].push_back(
        make_table(e, fmt::format("table1-work-{}", samples[i]), "Work, " + names[i], names[i], samples[i], work, true)
            .json());
  ReportTable defaults("table1-defaults", "This program's own defaults: one grid, up to eight nodes a pixel",
                       {{.name = "scene", .text = true},
                        {.name = "shadow stages", .unit = "ms", .group = "32 samples"},
                        {.name = "frame", .unit = "ms", .group = "32 samples"},
                        {.name = "nodes a receiver", .digits = 2, .group = "32 samples"},
                        {.name = "tests a receiver", .group = "32 samples"},
                        {.name = "shadow stages", .unit = "ms", .group = "1 sample"},
                        {.name = "frame", .unit = "ms", .group = "1 sample"},
                        {.name = "tests a receiver", .group = "1 sample"},
                        {.name = "32 / 1", .digits = 2}});
  for (const Measured* m : e.jobs) {
    const std::string many = "32 samples, defaults", one = "1 sample, defaults";
    defaults.add({scene_label(*m), value(*m, many, "shadow_ms"), value(*m, many, "frame_ms"),
                  value(*m, many, "averages/nodes_a_receiver"), value(*m, many, "averages/tests_a_receiver"),
                  value(*m, one, "shadow_ms"), value(*m, one, "frame_ms"), value(*m, one, "averages/tests_a_receiver"),
                  ratio(value(*m, many, "shadow_ms"), value(*m, one, "shadow_ms"))});
  }
  section["tables"].push_back(defaults.json());
  section["tables"].push_back(peer_table(e).json());
  section["plots"] = {stage_plot(e, names[0]), tests_plot(e, names[0])};
  section["notes"].push_back(e.paper["note"]);
  for (const Measured* m : e.jobs)
    if (m->works() && m->result.contains("pictures")) section["images"].push_back(m->result["pictures"]);
  return section;
}

}  // namespace izb::bench
