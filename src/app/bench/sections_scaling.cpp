// SPDX-License-Identifier: MIT
// Figures 8 and 9: time over the picture's resolution, over an animation, and over the light-space grid's resolution.
#include <algorithm>

#include "app/bench/report_table.h"
#include "app/bench/sections.h"
#include "app/results.h"
#include "base/error.h"

namespace izb::bench {

using nlohmann::json;

namespace {

/// Configurations are named "SERIES, X": the X of one series in the order of the sweep.
std::vector<std::string> places(const std::vector<const Measured*>& jobs, const std::string& prefix) {
  std::vector<std::string> list;
  for (const std::string& name : configuration_names(jobs))
    if (name.starts_with(prefix)) list.push_back(name.substr(prefix.size()));
  return list;
}

const std::string of_32 = "32 samples, ", of_1 = "1 sample, ";

/// The paper's left half: one scene's stages over the resolution.
json stages_over_size(const Measured& m, const std::vector<std::string>& sizes) {
  json plot =
      new_plot("figure8-stages", "stacked", "Stages over the picture's resolution: " + scene_label(m) + ", 32 samples",
               {"resolution", "", "category"}, {"time", "ms"}, sizes);
  for (const char* stage : {"gbuffer", "bounds", "occluders", "build", "zcull", "visibility", "shade"}) {
    std::vector<json> values;
    for (const std::string& size : sizes) values.push_back(value(m, of_32 + size, std::string("stages/") + stage));
    plot["series"].push_back(series(stage, std::move(values)));
  }
  return plot;
}

void add_resolution(json& section, const std::vector<const Measured*>& jobs) {
  if (jobs.empty()) return;
  const std::vector<std::string> sizes = places(jobs, of_32);
  std::vector<ReportColumn> header{{.name = "scene", .text = true}, {.name = "samples", .digits = 0}};
  for (const std::string& size : sizes) header.push_back({.name = size, .unit = "ms", .group = "frame"});
  header.push_back({.name = "2160p / 1080p", .digits = 2});
  header.push_back({.name = "2160p / 1080p", .digits = 1, .paper = true});
  ReportTable table("figure8-resolution", "Time of a frame over the picture's resolution", header);
  json plot = new_plot("figure8-frames", "line", "Time of a frame over the picture's resolution",
                       {"resolution", "", "category"}, {"time", "ms"}, sizes);
  for (const Measured* m : jobs)
    for (const auto& [prefix, samples] : {std::pair{of_32, 32}, std::pair{of_1, 1}}) {
      std::vector<json> row{scene_label(*m), samples}, values;
      for (const std::string& size : sizes) values.push_back(value(*m, prefix + size, "frame_ms"));
      row.insert(row.end(), values.begin(), values.end());
      row.push_back(ratio(value(*m, prefix + "2160p", "frame_ms"), value(*m, prefix + "1080p", "frame_ms")));
      row.push_back(samples == 32 && m->job.scene.procedural == "town"
                        ? json(2.0)
                        : no_value("the paper shows its Citadel at 32 samples"));
      table.add(std::move(row));
      plot["series"].push_back(
          series(fmt::format("{}, {} sample{}", scene_label(*m), samples, samples == 1 ? "" : "s"), std::move(values)));
    }
  section["tables"].push_back(table.json());
  section["plots"].push_back(stages_over_size(*jobs.front(), sizes));
  section["plots"].push_back(std::move(plot));
}

/// The least of the sorted values that so many percent of them do not exceed.
double nearest_rank(const std::vector<double>& sorted, size_t percent) {
  return sorted.at((percent * sorted.size() + 99) / 100 - 1);
}

void add_animation(json& section, const std::vector<const Measured*>& jobs) {
  ReportTable table("figure8-animation", "Time of a frame along an animated path",
                    {{.name = "scene", .text = true},
                     {.name = "configuration", .text = true},
                     {.name = "frames", .digits = 0},
                     {.name = "least", .unit = "ms"},
                     {.name = "median", .unit = "ms"},
                     {.name = "95 %", .unit = "ms"},
                     {.name = "worst", .unit = "ms"},
                     {.name = "worst / median", .digits = 2}});
  int number = 0;
  for (const Measured* m : jobs) {
    json plot =
        new_plot(fmt::format("figure8-animation-{}", ++number), "line",
                 "Time of a frame along the path: " + scene_label(*m) + ", " + m->job.size, {"frame"}, {"time", "ms"});
    for (int i = 0; i < m->job.frames; ++i) plot["x"]["values"].push_back(i);
    for (const Configuration& c : m->job.configurations) {
      const json* const result = find_configuration(*m, c.name);
      if (!result || result->contains("failed")) {
        const json reason = value(*m, c.name, "frame_ms");
        table.add({scene_label(*m), c.name, m->job.frames, reason, reason, reason, reason, reason});
        continue;
      }
      std::vector<double> ms = result->at("frame_samples");
      plot["series"].push_back(series(c.name, std::vector<json>(ms.begin(), ms.end())));
      std::sort(ms.begin(), ms.end());
      table.add({scene_label(*m), c.name, ms.size(), ms.front(), median(ms), nearest_rank(ms, 95), ms.back(),
                 ratio(ms.back(), median(ms))});
    }
    if (!plot["series"].empty()) section["plots"].push_back(std::move(plot));
  }
  if (!table.empty()) section["tables"].push_back(table.json());
}

}  // namespace

json figure8_section(const Evidence& e) {
  json section =
      new_section("figure8", "Figure 8: time over resolution and over an animation",
                  {"The paper found that four times the pixels, from 1080p to 2160p, take about twice the time, and "
                   "laid it to node removal, which spares the longer lists their shadowed nodes (its section 7).",
                   "The animation is the scene's own camera path. The paper's has 3600 frames; where ours has fewer, "
                   "they are spread over the same path."});
  add_resolution(section, e.of_part("resolution"));
  add_animation(section, e.of_part("animation"));
  return section;
}

json figure9_section(const Evidence& e) {
  json section = new_section("figure9", "Figure 9: time over the light-space grid's resolution",
                             {"Time of the stage visibility alone, with four cascades, as in the paper: finer grids "
                              "have shorter lists and more fragments. It found the best between 1400 and 2500 texels, "
                              "and that one sample does not mind finer ones."});
  std::vector<ReportColumn> header{{.name = "scene", .text = true}, {.name = "samples", .digits = 0}};
  const std::vector<std::string> grids = places(e.jobs, of_32);
  for (const std::string& grid : grids) header.push_back({.name = grid, .unit = "ms", .group = "visibility, grid of"});
  header.push_back({.name = "best grid", .unit = "texels", .digits = 0});
  header.push_back({.name = "best grid", .unit = "texels", .paper = true, .text = true});
  ReportTable table("figure9", "Time of visibility over the side of the grid (four cascades)", header);
  json x = json::array();
  for (const std::string& grid : grids) x.push_back(std::stoi(grid));
  for (const auto& [prefix, samples] : {std::pair{of_32, 32}, std::pair{of_1, 1}}) {
    json plot = new_plot(fmt::format("figure9-{}", samples), "line",
                         fmt::format("{} sample{} a pixel", samples, samples == 1 ? "" : "s"),
                         {"grid", "texels", "log"}, {"time", "ms"}, x);
    for (const Measured* m : e.jobs) {
      std::vector<json> row{scene_label(*m), samples}, values;
      json best = no_value("no grid has a time");
      double least = 0.0;
      for (const std::string& grid : grids) {
        values.push_back(value(*m, prefix + grid, "stages/visibility"));
        if (values.back().is_number() && (!best.is_number() || values.back().get<double>() < least)) {
          best = std::stoi(grid);
          least = values.back();
        }
      }
      row.insert(row.end(), values.begin(), values.end());
      row.push_back(best);
      row.push_back(samples == 32 ? json("1400 to 2500") : json("fine enough ones alike"));
      table.add(std::move(row));
      plot["series"].push_back(series(scene_label(*m), std::move(values)));
    }
    section["plots"].push_back(std::move(plot));
  }
  section["tables"].push_back(table.json());
  return section;
}

}  // namespace izb::bench
