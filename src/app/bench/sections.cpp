// SPDX-License-Identifier: MIT
#include "app/bench/sections.h"

#include <algorithm>
#include <set>

#include "app/bench/report_table.h"
#include "app/results.h"
#include "base/error.h"

namespace izb::bench {

using nlohmann::json;

std::vector<const Measured*> Evidence::of_part(const std::string& part) const {
  std::vector<const Measured*> list;
  for (const Measured* m : jobs)
    if (m->job.part == part) list.push_back(m);
  return list;
}

const json* find_configuration(const Measured& m, const std::string& name) {
  if (!m.works() || !m.result.contains("configurations")) return nullptr;
  for (const json& c : m.result["configurations"])
    if (c.at("name") == name) return &c;
  return nullptr;
}

namespace {

json stage_ms(const json& configuration, const std::string& name) {
  for (const json& stage : configuration["stages"])
    if (stage["name"] == name) return stage["gpu_ms"];
  return no_value("this technique has no such stage");
}

json shadow_ms(const json& configuration) {
  double sum = 0.0;
  for (const json& stage : configuration["stages"])
    for (const char* name : {"bounds", "occluders", "build", "zcull", "visibility"})
      if (stage["name"] == name) sum += stage["gpu_ms"].get<double>();
  return sum;
}

/// The value at a path "a/b", unless "a_failed" or "a/b_failed" beside it says why there is none.
json at_path(const json& configuration, const std::string& path) {
  const json::json_pointer pointer("/" + path);
  for (const std::string& of : {path.substr(0, path.find('/')), path})
    if (const json::json_pointer failed("/" + of + "_failed"); configuration.contains(failed))
      return no_value(configuration[failed]);
  if (configuration.contains(pointer) && !configuration[pointer].is_null()) return configuration[pointer];
  return no_value(path.starts_with("averages/") ? "nothing to take the mean of"
                                                : "not said by this technique or system");
}

}  // namespace

json value(const Measured& m, const std::string& configuration, const std::string& what, double scale) {
  if (!m.works()) return no_value(m.reason());
  const json* const c = find_configuration(m, configuration);
  if (!c) return no_value("not part of this run");
  if (c->contains("failed")) return no_value((*c)["failed"]);
  json number = what == "shadow_ms"           ? shadow_ms(*c)
                : what.starts_with("stages/") ? stage_ms(*c, what.substr(7))
                                              : at_path(*c, what);
  if (number.is_number()) number = number.get<double>() * scale;
  return number;
}

json ratio(const json& a, const json& b, double scale) {
  if (!a.is_number()) return a;
  if (!b.is_number()) return b;
  if (b.get<double>() == 0.0) return no_value("the divisor is 0");
  return scale * a.get<double>() / b.get<double>();
}

json plotted(const json& cell) {
  return cell.is_number() ? cell : json();
}

json median_of(const std::vector<json>& cells) {
  std::vector<double> numbers;
  for (const json& cell : cells)
    if (cell.is_number()) numbers.push_back(cell);
  if (numbers.empty()) return no_value("no scene has a value");
  return median(numbers);
}

std::vector<std::string> configuration_names(const std::vector<const Measured*>& jobs) {
  std::vector<std::string> names;
  for (const Measured* m : jobs)
    for (const Configuration& c : m->job.configurations)
      if (std::find(names.begin(), names.end(), c.name) == names.end()) names.push_back(c.name);
  return names;
}

std::string scene_label(const Measured& m) {
  if (m.job.scene.triangles == 0) return m.job.scene.name;
  const int triangles = m.job.scene.triangles;
  if (triangles < 1'000'000) return fmt::format("{} ({} k triangles)", m.job.scene.name, (triangles + 500) / 1000);
  return fmt::format("{} ({:.1f} M triangles)", m.job.scene.name, triangles * 1e-6);
}

json new_section(const std::string& id, const std::string& title, std::vector<std::string> text) {
  return {{"id", id},
          {"title", title},
          {"text", std::move(text)},
          {"facts", json::array()},
          {"notes", json::array()},
          {"tables", json::array()},
          {"plots", json::array()},
          {"images", json::array()}};
}

json new_plot(const std::string& id, const char* kind, const std::string& title, const PlotAxis& x, const PlotAxis& y,
              json values) {
  const auto axis = [](const PlotAxis& a) {
    json its{{"label", a.label}, {"scale", a.scale}};
    if (!a.unit.empty()) its["unit"] = a.unit;
    return its;
  };
  json plot{{"id", id}, {"kind", kind}, {"title", title}, {"x", axis(x)}, {"y", axis(y)}, {"series", json::array()}};
  plot["x"]["values"] = std::move(values);
  return plot;
}

json scene_labels(const std::vector<const Measured*>& jobs) {
  json labels = json::array();
  for (const Measured* m : jobs) labels.push_back(scene_label(*m));
  return labels;
}

json series(const std::string& name, std::vector<json> values, bool paper) {
  for (json& v : values) v = plotted(v);
  return {{"name", name}, {"values", std::move(values)}, {"source", paper ? "paper" : "measured"}};
}

namespace {

using Section = json (*)(const Evidence&);

struct NamedSection {
  const char* experiment;
  Section section;
};

constexpr NamedSection sections[] = {
    {"table1", table1_section},   {"table2", table2_section},     {"figure8", figure8_section},
    {"figure9", figure9_section}, {"figure10", figure10_section}, {"ablations", ablations_section},
    {"memory", memory_section},   {"temporal", temporal_section}, {"peers", peers_section}};

/// A logarithmic axis has no place for 0, which the tables show.
void leave_out_zeros(json& plot) {
  if (plot["y"]["scale"] != "log") return;
  bool some = false;
  for (json& series : plot["series"])
    for (json& v : series["values"])
      if (v.is_number() && !(v.get<double>() > 0.0)) v = nullptr, some = true;
  if (some) plot["caption"] = "Zeros have no place on the logarithmic axis; the tables have them.";
}

/// What was measured how, and what was left out.
void add_conditions(json& section, const Evidence& evidence, bool software) {
  std::set<std::string> sizes, frames, smaller;
  size_t failed = 0, missing = 0, configurations = 0, refused = 0;
  for (const Measured* m : evidence.jobs) {
    if (m->works())
      for (const json& c : m->result.value("configurations", json::array()))
        ++configurations, refused += c.contains("failed");
    sizes.insert(m->job.size);
    frames.insert(std::to_string(m->job.frames));
    if (m->job.scene.triangles != 0) smaller.insert(scene_label(*m));
    failed += m->result.is_object() && !m->works();
    missing += m->result.is_null();
  }
  section["facts"].push_back(json::array({"picture", fmt::format("{}", fmt::join(sizes, ", "))}));
  section["facts"].push_back(json::array({"frames timed", fmt::format("{}", fmt::join(frames, ", "))}));
  if (!smaller.empty())
    section["notes"].push_back(
        fmt::format("Scenes with fewer triangles than their own: {}.", fmt::join(smaller, ", ")));
  if (failed > 0) section["notes"].push_back(fmt::format("{} of {} jobs failed.", failed, evidence.jobs.size()));
  if (missing > 0)
    section["notes"].push_back(fmt::format("{} of {} jobs were not run until now.", missing, evidence.jobs.size()));
  if (refused > 0)
    section["notes"].push_back(
        fmt::format("{} of {} configurations could not be measured: the tables say why.", refused, configurations));
  std::vector<std::string> named;
  for (const Measured* m : evidence.jobs)
    for (const Configuration& c : m->job.configurations) {
      if (std::find(named.begin(), named.end(), c.name) != named.end()) continue;
      named.push_back(c.name);
      section["facts"].push_back(
          json::array({c.name, "`" + c.command_line() + (c.size.empty() ? "" : " --size " + c.size) + "`"}));
    }
  section["software"] = software;
  for (json& plot : section["plots"]) {
    plot["software"] = software;
    leave_out_zeros(plot);
  }
}

json facts(const json& made, const std::string& command, const std::string& extent) {
  const json& machine = made["machine"];
  const auto text = [](const json& j) { return j.is_string() ? j.get<std::string>() : std::string("not said"); };
  std::string memory = "not said";
  if (machine["memory_bytes"].is_number())
    memory = fmt::format("{:.1f} GB", machine["memory_bytes"].get<double>() / 1e9);
  json list = json::array();
  const auto add = [&](const std::string& key, const std::string& fact) { list.push_back(json::array({key, fact})); };
  add("machine", fmt::format("{}, {} cores, {}", text(machine["processor"]), machine["cores"].get<int>(), memory));
  add("system", text(machine["system"]));
  add("OpenGL", fmt::format("{}, {} ({})", text(made["gl"]["renderer"]), text(made["gl"]["version"]),
                            text(made["gl"]["context"])));
  add("times by", made["timing"] == "wall" ? "the wall clock between finishes" : "timer queries");
  add("ray tracer", text(made["embree"]));
  add("izb", text(made["version"]));
  add("command", "`" + command + "`");
  add("extent", extent);
  add("written", text(made["date"]));
  return list;
}

}  // namespace

json make_document(const std::vector<Measured>& results, const json& paper, const json& made,
                   const std::string& command, const std::string& extent) {
  const bool software = made["software"];
  json document{{"title", "izb bench"},
                {"subtitle", "Frustum-Traced Raster Shadows (Wyman, Hoetzlein and Lefohn 2015), measured"},
                {"facts", facts(made, command, extent)},
                {"software", software},
                {"sections", json::array()}};
  for (const NamedSection& named : sections) {
    Evidence evidence{{}, paper};
    for (const Measured& m : results)
      if (m.job.experiment == named.experiment) evidence.jobs.push_back(&m);
    if (evidence.jobs.empty()) continue;
    json section = named.section(evidence);
    add_conditions(section, evidence, software);
    document["sections"].push_back(std::move(section));
  }
  return document;
}

}  // namespace izb::bench
