// SPDX-License-Identifier: MIT
// What each option costs or saves, and what each technique takes of memory.
#include <set>

#include "app/bench/report_table.h"
#include "app/bench/sections.h"
#include "base/error.h"

namespace izb::bench {

using nlohmann::json;

namespace {

/// By how many percent a number of a configuration is above that of the defaults.
json change(const Measured& m, const std::string& configuration, const std::string& what) {
  const json share = ratio(value(m, configuration, what), value(m, "defaults", what));
  return share.is_number() ? json(100.0 * (share.get<double>() - 1.0)) : share;
}

std::vector<json> changes(const Evidence& e, const std::string& configuration, const std::string& what) {
  std::vector<json> list;
  for (const Measured* m : e.jobs) list.push_back(change(*m, configuration, what));
  return list;
}

json extreme(const std::vector<json>& cells, bool largest) {
  json best;
  for (const json& cell : cells)
    if (cell.is_number() && (best.is_null() || (cell > best) == largest)) best = cell;
  return best;
}

std::string papers_claim(const Evidence& e, const std::string& name) {
  for (const Measured* m : e.jobs)
    for (const Configuration& c : m->job.configurations)
      if (c.name == name) return c.notes.value("paper", "");
  return {};
}

}  // namespace

json ablations_section(const Evidence& e) {
  json section =
      new_section("ablations", "Section 6: every option alone",
                  {"Each option otherwise than by default, on the same frames, in percent of what the defaults take: "
                   "time of the shadow stages (bounds to visibility), and counts. Below 0 is less. Where an option is "
                   "on by default, the paper's claim is read the other way round."});
  std::vector<ReportColumn> header{{.name = "option", .text = true}, {.name = "claim", .paper = true, .text = true}};
  for (const Measured* m : e.jobs) header.push_back({.name = scene_label(*m), .unit = "%", .group = "time"});
  for (const char* name : {"time", "fragments", "tests", "nodes"})
    header.push_back({.name = name, .unit = "%", .group = "median of the scenes"});
  ReportTable table("ablations", "Change against the defaults", header);
  json plot = new_plot("ablations-time", "bars",
                       "Time of the shadow stages against the defaults: median and extremes of the scenes",
                       {"option", "", "category"}, {"time", "%"});
  std::vector<json> middle, low, high;
  for (const std::string& name : configuration_names(e.jobs)) {
    if (name == "defaults") continue;
    const std::vector<json> time = changes(e, name, "shadow_ms");
    const std::string claim = papers_claim(e, name);
    std::vector<json> row{name, claim.empty() ? no_value("not in the paper") : json(claim)};
    row.insert(row.end(), time.begin(), time.end());
    row.push_back(median_of(time));
    for (const char* count : {"counts/fragments_after_zcull", "counts/visibility_tests", "counts/nodes"})
      row.push_back(median_of(changes(e, name, count)));
    table.add(std::move(row));
    plot["x"]["values"].push_back(name);
    middle.push_back(median_of(time));
    low.push_back(extreme(time, false));
    high.push_back(extreme(time, true));
  }
  json bars = series("time", middle);
  bars["low"] = low, bars["high"] = high;
  plot["series"].push_back(std::move(bars));
  section["tables"].push_back(table.json());
  section["plots"].push_back(std::move(plot));
  return section;
}

json memory_section(const Evidence& e) {
  json section =
      new_section("memory", "Memory",
                  {"What each technique holds after a frame, by group: its own structures and the mask, the G-buffer "
                   "with the picture, the scene; and the most that the process held, which on a software renderer "
                   "contains all of it, the scene's copy for the CPU, and the driver. Each in a process of its own."});
  const char* groups[] = {"technique", "gbuffer", "scene"};
  ReportTable table("memory", "Bytes after a frame",
                    {{.name = "scene", .text = true},
                     {.name = "configuration", .text = true},
                     {.name = "picture", .text = true},
                     {.name = "technique", .unit = "MB", .group = "held"},
                     {.name = "G-buffer", .unit = "MB", .group = "held"},
                     {.name = "scene", .unit = "MB", .group = "held"},
                     {.name = "process, at most", .unit = "MB"}});
  json plot = new_plot("memory-plot", "stacked", "Memory by configuration: " + scene_label(*e.jobs.front()),
                       {"configuration", "", "category"}, {"memory", "MB"});
  std::vector<json> values[3];
  for (const Measured* m : e.jobs) {
    const Configuration& c = m->job.configurations.at(0);
    std::vector<json> row{scene_label(*m), c.name, c.size.empty() ? m->job.size : c.size};
    for (int i = 0; i < 3; ++i) {
      const std::string key = i == 0 ? c.technique : groups[i];
      row.push_back(value(*m, c.name, "memory_bytes/" + key, 1e-6));
      if (m->job.scene.name == e.jobs.front()->job.scene.name) values[i].push_back(row.back());
    }
    row.push_back(value(*m, c.name, "memory_peak_bytes", 1e-6));
    table.add(std::move(row));
    if (m->job.scene.name == e.jobs.front()->job.scene.name) plot["x"]["values"].push_back(c.name);
  }
  for (int i = 0; i < 3; ++i) plot["series"].push_back(series(groups[i], values[i]));
  section["tables"].push_back(table.json());
  section["plots"].push_back(std::move(plot));
  return section;
}

}  // namespace izb::bench
