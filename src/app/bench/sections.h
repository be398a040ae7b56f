// SPDX-License-Identifier: MIT
// The tables and plots of each experiment, from the results of its jobs, as make_report() takes them.
#pragma once
#include "app/bench/runner.h"

namespace izb::bench {

/// What a section is made from.
struct Evidence {
  std::vector<const Measured*> jobs;  ///< of one experiment, in the order of the plan
  const nlohmann::json& paper;        ///< bench/paper.json

  /// Those of one part.
  std::vector<const Measured*> of_part(const std::string& part) const;
};

/// A configuration's number of a result: "stages/NAME" (median ms), "shadow_ms" (bounds, build, zcull and visibility),
/// "frame_ms", or a path into its JSON such as "counts/nodes". Or no_value() with the reason: "a_failed" or
/// "a/b_failed" beside the value a/b says it.
nlohmann::json value(const Measured& m, const std::string& configuration, const std::string& what, double scale = 1.0);
/// The configuration's JSON, or null.
const nlohmann::json* find_configuration(const Measured& m, const std::string& name);
/// A quotient, or the reason of the one that is not there.
nlohmann::json ratio(const nlohmann::json& a, const nlohmann::json& b, double scale = 1.0);
/// A number for a plot: null where there is none.
nlohmann::json plotted(const nlohmann::json& cell);
/// The median of the cells that are numbers, or no_value().
nlohmann::json median_of(const std::vector<nlohmann::json>& cells);
/// Its configurations' names, in the order of the sweep.
std::vector<std::string> configuration_names(const std::vector<const Measured*>& jobs);
/// "villa", or where it has another number of triangles than its own "villa (60 k triangles)".
std::string scene_label(const Measured& m);
/// An empty section: `id`, `title`, `text`, and the lists that sections fill.
nlohmann::json new_section(const std::string& id, const std::string& title, std::vector<std::string> text);
struct PlotAxis {
  std::string label, unit = {}, scale = "linear";
};
/// A plot without series; its x values are `values`, or to be added.
nlohmann::json new_plot(const std::string& id, const char* kind, const std::string& title, const PlotAxis& x,
                        const PlotAxis& y, nlohmann::json values = nlohmann::json::array());
/// Of each job its scene_label().
nlohmann::json scene_labels(const std::vector<const Measured*>& jobs);
/// {"name", "values", "source"}.
nlohmann::json series(const std::string& name, std::vector<nlohmann::json> values, bool paper = false);

nlohmann::json table1_section(const Evidence& evidence);
nlohmann::json table2_section(const Evidence& evidence);
nlohmann::json figure10_section(const Evidence& evidence);
nlohmann::json temporal_section(const Evidence& evidence);
nlohmann::json peers_section(const Evidence& evidence);
nlohmann::json figure8_section(const Evidence& evidence);
nlohmann::json figure9_section(const Evidence& evidence);
nlohmann::json ablations_section(const Evidence& evidence);
nlohmann::json memory_section(const Evidence& evidence);

/// The whole report: facts of the machine and a section for each experiment that the plan has. `command`: how it came
/// about.
nlohmann::json make_document(const std::vector<Measured>& results, const nlohmann::json& paper,
                             const nlohmann::json& made, const std::string& command, const std::string& extent);

}  // namespace izb::bench
