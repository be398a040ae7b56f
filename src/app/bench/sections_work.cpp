// SPDX-License-Identifier: MIT
// Table 2 and figure 10: the tests, how fast they could be, and how many a ray tracer would need.
#include "app/bench/report_table.h"
#include "app/bench/sections.h"
#include "base/error.h"

namespace izb::bench {

using nlohmann::json;

json table2_section(const Evidence& e) {
  json section =
      new_section("table2", "Table 2: speed of light",
                  {"A frame's tests are stored, then a compute pass makes them all, one an invocation, with nothing to "
                   "find out: what the tests alone take. Beside it, how many tests a millisecond the stage visibility "
                   "gets through, with its rasterisation, its walks along the lists and its divergence. The pairs that "
                   "single precision leaves undecided are decided in double in both. Where the stored tests do not "
                   "give the frame's mask, bit for bit, the row says so."});
  ReportTable table("table2", "Speed of light at 32 samples",
                    {{.name = "scene", .text = true},
                     {.name = "tests", .unit = "millions", .group = "ours"},
                     {.name = "speed of light", .unit = "ms", .group = "ours"},
                     {.name = "tests / ms", .unit = "thousands", .group = "ours"},
                     {.name = "visibility: tests / ms", .unit = "thousands", .group = "ours"},
                     {.name = "share of it", .unit = "%", .group = "ours"},
                     {.name = "tests", .unit = "millions", .group = "paper", .paper = true},
                     {.name = "speed of light", .unit = "ms", .group = "paper", .paper = true},
                     {.name = "tests / ms", .unit = "thousands", .digits = 0, .group = "paper", .paper = true},
                     {.name = "best: tests / ms", .unit = "thousands", .digits = 0, .group = "paper", .paper = true},
                     {.name = "share of it", .unit = "%", .digits = 0, .group = "paper", .paper = true}});
  json plot = new_plot("table2-share", "bars", "Throughput of the stage visibility", {"scene", "", "category"},
                       {"share of the speed of light", "%"}, scene_labels(e.jobs));
  std::vector<json> ours, theirs;
  const std::string name = "32 samples";
  for (const Measured* m : e.jobs) {
    const json tests = value(*m, name, "speed_of_light/tests"), ms = value(*m, name, "speed_of_light/ms");
    const json light = ratio(tests, ms, 1e-3);
    const json real = ratio(value(*m, name, "counts/visibility_tests"), value(*m, name, "stages/visibility"), 1e-3);
    std::vector<json> row{
        scene_label(*m),          tests.is_number() ? json(tests.get<double>() * 1e-6) : tests, ms, light, real,
        ratio(real, light, 100.0)};
    ours.push_back(row.back());
    const json& paper = e.paper["table2"];
    if (paper.contains(m->job.scene.procedural)) {
      const json& p = paper[m->job.scene.procedural];
      const double best = p["best_millions_a_ms"], most = p["speed_of_light_millions_a_ms"];
      row.insert(row.end(), {p["tests_millions"], p["speed_of_light_ms"], 1e3 * most, 1e3 * best, 100.0 * best / most});
      theirs.push_back(100.0 * best / most);
    } else {
      for (int i = 0; i < 5; ++i) row.push_back(no_value("not in the paper's table 2"));
      theirs.push_back(nullptr);
    }
    table.add(std::move(row));
  }
  plot["series"] = {series("ours", ours), series("paper", theirs, true)};
  section["tables"].push_back(table.json());
  section["plots"].push_back(std::move(plot));
  return section;
}

json figure10_section(const Evidence& e) {
  json section =
      new_section("figure10", "Figure 10: tests against a ray tracer's",
                  {"The paper put its frustum tests into a beam tracer and counted: an irregular z-buffer tested 0.3 "
                   "to 2.6 times as many triangles a pixel. Here the beam tracer is this program's own: one beam a "
                   "receiver, from its micro-quad to the light, through a hierarchy built by Embree's builder with "
                   "spatial splits; nearest child first, ending when all 32 samples are in shadow. A triangle is "
                   "counted once for each leaf in which a beam meets it."});
  ReportTable table("figure10", "Triangle tests a receiver at 32 samples",
                    {{.name = "scene", .text = true},
                     {.name = "izb, as in the paper", .group = "tests a receiver"},
                     {.name = "izb, defaults", .group = "tests a receiver"},
                     {.name = "beam tracer", .group = "tests a receiver"},
                     {.name = "boxes", .group = "beam tracer"},
                     {.name = "as in the paper / beams", .digits = 2, .group = "ratio"},
                     {.name = "defaults / beams", .digits = 2, .group = "ratio"},
                     {.name = "ratio", .paper = true, .text = true}});
  json plot = new_plot("figure10-plot", "bars", "Triangle tests a receiver", {"scene", "", "category"},
                       {"tests a receiver", "", "log"}, scene_labels(e.jobs));
  std::vector<json> paper_setting, defaults, beams;
  for (const Measured* m : e.jobs) {
    paper_setting.push_back(value(*m, "32 samples, as in the paper", "averages/tests_a_receiver"));
    defaults.push_back(value(*m, "32 samples, defaults", "averages/tests_a_receiver"));
    beams.push_back(value(*m, "32 samples, defaults", "beams/tests_a_receiver"));
    table.add({scene_label(*m), paper_setting.back(), defaults.back(), beams.back(),
               value(*m, "32 samples, defaults", "beams/node_tests_a_receiver"),
               ratio(paper_setting.back(), beams.back()), ratio(defaults.back(), beams.back()), "0.3 to 2.6"});
  }
  plot["series"] = {series("izb, as in the paper", paper_setting), series("izb, defaults", defaults),
                    series("beam tracer", beams)};
  section["tables"].push_back(table.json());
  section["plots"].push_back(std::move(plot));
  return section;
}

}  // namespace izb::bench
