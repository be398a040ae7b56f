// SPDX-License-Identifier: MIT
// The report's tables and plots, made from made-up results: whatever failed or is missing, and that numbers are right.
#include "app/bench/sections.h"

#include <gtest/gtest.h>

#include <cmath>

#include "app/bench/report.h"
#include "app/bench/report_document.h"
#include "app/bench/report_table.h"
#include "app/bench/sweep.h"
#include "base/error.h"
#include "cpu/bench_results.h"
#include "cpu/gltf_writer.h"

namespace {

using namespace izb::bench;
using namespace izb::test;

constexpr Extent extents[] = {Extent::quick, Extent::full, Extent::complete};

const json& paper() {
  static const json its = bench_data("paper.json");
  return its;
}

std::vector<Job> shipped(Extent extent, const std::vector<std::string>& experiments = {}) {
  SweepRequest request;
  request.extent = extent, request.experiments = experiments;
  return plan(bench_data("sweeps.json"), json::object(), request, "/out");
}

std::vector<Measured> measured(const std::vector<Job>& jobs) {
  std::vector<Measured> all;
  for (const Job& job : jobs) all.push_back({job, made_up_result(job)});
  return all;
}

json document_of(const std::vector<Measured>& all) {
  return make_document(all, paper(), made_up_conditions(), "izb bench", "quick");
}

/// What every document must be.
void expect_sound(const json& document) {
  const std::string html = izb::make_report(document, "/nonexistent");
  EXPECT_EQ(html.substr(html.size() - 8), "</html>\n");
  std::set<std::string> ids;
  for (const json& section : document["sections"]) {
    SCOPED_TRACE(section["id"]);
    EXPECT_FALSE(section["tables"].empty());
    for (const json& table : section["tables"]) {
      SCOPED_TRACE(table["id"]);
      EXPECT_TRUE(ids.insert(table["id"]).second);
      EXPECT_FALSE(table["rows"].empty());
      for (const json& row : table["rows"])
        for (const json& cell : row) {
          const json& text = cell.is_object() ? cell.at("reason") : cell;
          EXPECT_TRUE((cell.is_number() && std::isfinite(cell.get<double>())) || (text.is_string() && text != ""))
              << cell;
        }
      const std::string csv = csv_of(table), header = csv.substr(0, csv.find("\r\n"));
      EXPECT_EQ(csv.find("nan"), std::string::npos);
      std::set<std::string> names;
      const json columns = table["columns"];
      for (const json& c : columns)
        names.insert(c.value("group", "") + "|" + c["name"].get<std::string>() + "|" + c.value("source", ""));
      EXPECT_EQ(names.size(), columns.size()) << header;
    }
  }
}

const json& find_table(const json& document, const std::string& id) {
  for (const json& section : document["sections"])
    for (const json& table : section["tables"])
      if (table["id"] == id) return table;
  throw std::runtime_error("no table " + id);
}

/// A cell by the table's first column, or the first two ("a|b"), and the column's group and name.
json cell(const json& document, const std::string& id, const std::string& row_name, const std::string& column_name,
          const std::string& group = "", const std::string& source = "measured") {
  const json& table = find_table(document, id);
  for (const json& row : table["rows"]) {
    const std::string first = row[0].get<std::string>();
    if (row_name != first && !(row[1].is_string() && row_name == first + "|" + row[1].get<std::string>())) continue;
    for (size_t i = 0; i < row.size(); ++i) {
      const json& c = table["columns"][i];
      if (c["name"] == column_name && c.value("group", "") == group && c["source"] == source) return row[i];
    }
    throw std::runtime_error("no column " + column_name);
  }
  throw std::runtime_error("no row " + row_name);
}

json plot_of(const json& document, const std::string& id) {
  for (const json& section : document["sections"])
    for (const json& plot : section["plots"])
      if (plot["id"] == id) return plot;
  throw std::runtime_error("no plot " + id);
}

std::string notes_of(const json& document) {
  std::string text;
  for (const json& section : document["sections"])
    for (const json& note : section["notes"]) text += note.get<std::string>() + "\n";
  return text;
}

std::string reason(const json& cell) {
  return cell.is_object() ? cell.at("reason").get<std::string>() : "a value";
}

TEST(BenchSections, OfEveryExtentAreAReport) {
  for (const Extent extent : extents) {
    const json document = document_of(measured(shipped(extent)));
    EXPECT_EQ(document["sections"].size(), std::size(experiment_names));
    expect_sound(document);
  }
}

TEST(BenchSections, OfEachExperimentAloneAreAReport) {
  for (const std::string name : experiment_names) {
    const json document = document_of(measured(shipped(Extent::quick, {name})));
    ASSERT_EQ(document["sections"].size(), 1u);
    EXPECT_EQ(document["sections"][0]["id"], name);
    expect_sound(document);
  }
}

TEST(BenchSections, SayWhatWasNotRunUntilNow) {
  std::vector<Measured> all = measured(shipped(Extent::quick));
  for (Measured& m : all) m.result = nullptr;
  const json document = document_of(all);
  expect_sound(document);
  EXPECT_EQ(reason(cell(document, "table1-defaults", scene_label(all[0]), "frame", "32 samples")),
            "not measured until now");
  EXPECT_NE(notes_of(document).find("3 of 3 jobs were not run until now"), std::string::npos);
}

TEST(BenchSections, SayWhyAJobFailed) {
  std::vector<Measured> all = measured(shipped(Extent::quick));
  for (size_t i = 0; i < all.size(); ++i)
    all[i].result = {{"job", to_json(all[i].job)}, {"failed", "not done after 5 s"}, {"made", made_up_conditions()}};
  json document = document_of(all);
  expect_sound(document);
  EXPECT_EQ(reason(cell(document, "peers", "izb, 32 samples", "error")), "no scene has a value");
  for (const char* table : {"table2", "figure10", "peers-verdicts"}) {
    const json row = find_table(document, table)["rows"][0];
    EXPECT_NE(std::find(row.begin(), row.end(), no_value("not done after 5 s")), row.end()) << table;
  }
  // One of several: the others keep their values.
  all = measured(shipped(Extent::quick, {"table1"}));
  all[1].result = {{"job", to_json(all[1].job)}, {"failed", "it broke"}, {"made", made_up_conditions()}};
  document = document_of(all);
  expect_sound(document);
  EXPECT_EQ(reason(cell(document, "table1-defaults", scene_label(all[1]), "frame", "1 sample")), "it broke");
  EXPECT_EQ(cell(document, "table1-defaults", scene_label(all[0]), "frame", "1 sample"), 4 * 28.0);
  EXPECT_NE(notes_of(document).find("1 of 3 jobs failed."), std::string::npos);
}

TEST(BenchSections, SayWhyAConfigurationFailed) {
  for (size_t which = 0; which < 3; ++which) {
    std::vector<Measured> all = measured(shipped(Extent::quick));
    for (Measured& m : all) {
      json& list = m.result["configurations"];
      json& c = list[which % list.size()];
      c = {{"name", c["name"]}, {"technique", c["technique"]}, {"failed", "out of memory"}};
    }
    const json document = document_of(all);
    expect_sound(document);
    EXPECT_NE(notes_of(document).find("configurations could not be measured"), std::string::npos);
  }
  std::vector<Measured> all = measured(shipped(Extent::quick, {"table1"}));
  for (json& c : all[0].result["configurations"])
    if (c["name"] == "1 sample, defaults") c = {{"name", c["name"]}, {"failed", "out of memory"}};
  const json document = document_of(all);
  EXPECT_EQ(reason(cell(document, "table1-defaults", scene_label(all[0]), "32 / 1")), "out of memory");
  EXPECT_EQ(cell(document, "table1-defaults", scene_label(all[0]), "frame", "32 samples"), 3 * 28.0);
}

TEST(BenchSections, DoWithoutWhatABuildOrASceneLacks) {
  std::vector<Measured> all = measured(shipped(Extent::quick));
  for (Measured& m : all) {
    m.result.erase("peer");
    for (json& c : m.result["configurations"]) {
      // All sky: nothing is counted, and nothing is wrong.
      if (c.contains("counts"))
        for (json& count : c["counts"]) count = 0;
      if (c.contains("averages")) c["averages"] = json::object();
      if (c.contains("beams")) c["beams"] = {{"tests_a_receiver", 0.0}, {"node_tests_a_receiver", 0.0}};
      if (c.contains("speed_of_light")) c["speed_of_light_failed"] = "the stored tests alone gave another mask";
      if (c.contains("error"))
        for (json& pixels : c["error"])
          for (json& number : pixels) number = 0.0;
      if (c.contains("memory_peak_bytes")) c["memory_peak_bytes"] = nullptr;
    }
  }
  const json document = document_of(all);
  expect_sound(document);
  EXPECT_EQ(reason(cell(document, "table1-peer", scene_label(all[0]), "sum", "Embree, low quality")),
            "this build has no Embree");
  EXPECT_EQ(reason(find_table(document, "table2")["rows"][0][2]), "the stored tests alone gave another mask");
  EXPECT_EQ(plot_of(document, "peers-error")["series"][0]["values"][0], 0.0);
  const json logarithmic = plot_of(document, "figure10-plot");
  EXPECT_TRUE(logarithmic["series"][2]["values"][0].is_null());
  EXPECT_TRUE(logarithmic.contains("caption"));
  EXPECT_EQ(cell(document, "peers", "izb, 32 samples", "error"), 0.0);
  EXPECT_NE(notes_of(document).find("is as near to the truth as 32 samples of izb"), std::string::npos);
}

TEST(BenchSections, TakeAnyNameOfAScene) {
  std::vector<Measured> all;
  for (Job job : shipped(Extent::quick)) {
    job.scene.name = "a, \"b\" <c>'`ü / " + job.scene.name;
    all.push_back({job, made_up_result(job)});
  }
  expect_sound(document_of(all));
}

TEST(BenchSections, HaveATruthOrSayThatItIsMissing) {
  std::vector<Measured> all = measured(shipped(Extent::quick, {"temporal"}));
  json& list = all[0].result["configurations"];
  list[0] = {{"name", list[0]["name"]}, {"failed", "no rays"}};
  for (size_t i = 1; i < list.size(); ++i) {
    list[i]["temporal"].erase("mean_difference_from_truth");
    list[i]["temporal"]["mean_difference_from_truth_failed"] = "the truth could not be had";
  }
  const json document = document_of(all);
  expect_sound(document);
  const std::string row = scene_label(all[0]) + "|izb, 32 samples";
  EXPECT_EQ(reason(cell(document, "temporal-camera", row, "difference from the true change")),
            "the truth could not be had");
  EXPECT_DOUBLE_EQ(cell(document, "temporal-camera", row, "change").get<double>(), 2.0);
}

TEST(BenchSections, TakeStagesRatiosAndMediansRight) {
  std::vector<Measured> all = measured(shipped(Extent::quick, {"table1", "ablations", "figure8", "figure9", "memory"}));
  // visibility, of the third configuration: 6 times 3; bounds to visibility: 2 + 3 + 4 + 5 + 6.
  const Measured& m = all[0];
  EXPECT_EQ(value(m, "32 samples, defaults", "stages/visibility"), 18.0);
  EXPECT_EQ(value(m, "32 samples, defaults", "shadow_ms"), 60.0);
  EXPECT_EQ(value(m, "32 samples, defaults", "frame_ms"), 84.0);
  EXPECT_EQ(value(m, "32 samples, defaults", "counts/visibility_tests", 1e-6), 9.0);
  EXPECT_EQ(reason(value(m, "32 samples, defaults", "counts/nonesuch")), "not said by this technique or system");
  EXPECT_EQ(reason(value(m, "nonesuch", "frame_ms")), "not part of this run");
  EXPECT_EQ(ratio(3, 4, 100.0), 75.0);
  EXPECT_EQ(reason(ratio(3, 0)), "the divisor is 0");
  EXPECT_EQ(reason(ratio(no_value("a"), no_value("b"))), "a");
  EXPECT_EQ(reason(ratio(1, no_value("b"))), "b");
  EXPECT_EQ(median_of({5, no_value("x"), 1, 2}), 2.0);
  EXPECT_EQ(median_of({4, 1}), 2.5);
  EXPECT_EQ(reason(median_of({no_value("x")})), "no scene has a value");

  const json document = document_of(all);
  const std::string villa = scene_label(m), town = "town (60 k triangles)";
  EXPECT_EQ(cell(document, "table1-times-32", villa, "ours", "visibility"), 6.0);
  EXPECT_EQ(cell(document, "table1-times-32", villa, "theirs", "visibility", "paper"), 2.9);
  EXPECT_EQ(cell(document, "table1-work-1", villa, "ours", "tests"), 6.0);
  EXPECT_EQ(cell(document, "table1-peer", villa, "izb defaults / Embree"), 60.0 / 4.0);
  EXPECT_EQ(cell(document, "table1-times-32", "Bungie Building", "theirs", "frame", "paper"), 12.8);
  // The third ablation takes three times what the defaults take, and as many tests.
  EXPECT_EQ(cell(document, "ablations", "--zcull-pyramid off", "time", "median of the scenes"), 200.0);
  EXPECT_EQ(cell(document, "ablations", "--zcull off", town, "time"), 100.0);
  EXPECT_EQ(cell(document, "ablations", "--zcull off", "tests", "median of the scenes"), 100.0);
  EXPECT_EQ(cell(document, "figure8-resolution", town, "2160p / 1080p"), 4.0 / 3.0);
  // Samples run from 28 ms on by 1 ms a frame: 40 of them.
  EXPECT_EQ(cell(document, "figure8-animation", town, "least"), 28.0);
  EXPECT_EQ(cell(document, "figure8-animation", town, "median"), 47.5);
  EXPECT_EQ(cell(document, "figure8-animation", town, "95 %"), 65.0);
  EXPECT_EQ(cell(document, "figure8-animation", town, "worst"), 67.0);
  EXPECT_EQ(cell(document, "figure9", town, "best grid"), 256);
  EXPECT_EQ(cell(document, "memory", "villa (60 k triangles)|shadow map 2048", "technique", "held"), 1.0);
  EXPECT_EQ(cell(document, "memory", "villa (60 k triangles)|shadow map 2048", "process, at most"), 50.0);
}

TEST(BenchSections, TakeTheBestMapAndOwnUpWhereItIsNearer) {
  std::vector<Measured> all = measured(shipped(Extent::quick, {"peers"}));
  const auto set = [&](const std::string& name, const char* pixels, double mean) {
    for (json& c : all[0].result["configurations"])
      if (c["name"] == name) c["error"][pixels]["mean"] = mean;
  };
  const std::string scene = scene_label(all[0]);
  json document = document_of(all);
  EXPECT_EQ(notes_of(document).find("nearer to the truth"), std::string::npos);
  set("map 8192, disc of 32", "inner", 0.02);
  set("map 2048, unfiltered", "flat", 0.001);
  document = document_of(all);
  EXPECT_EQ(cell(document, "peers-verdicts", scene, "which", "error"), "map 8192, disc of 32");
  EXPECT_EQ(cell(document, "peers-verdicts", scene, "best map", "error"), 2.0);
  EXPECT_EQ(cell(document, "peers-verdicts", scene, "best map / izb"), 2.0);
  EXPECT_EQ(cell(document, "peers-verdicts", scene, "the best map there", "error, flat pixels"), 0.1);
  const char* bits = "bits unlike those of 32 rays at the same points";
  EXPECT_EQ(cell(document, "peers-verdicts", scene, "izb, 32 samples", bits), 0.125);
  EXPECT_EQ(cell(document, "peers-verdicts", scene, "izb, exact", bits), 0.0);
  EXPECT_EQ(cell(document, "peers-verdicts", scene, "the best map of 32 samples", bits), 2.5);
  EXPECT_NE(document.dump().find("its samples stand elsewhere"), std::string::npos)
      << "one sample has no 32 to compare";
  EXPECT_EQ(notes_of(document).find("the truth than 32 samples of izb"), std::string::npos);
  set("map 8192, disc of 32", "inner", 0.0099);
  document = document_of(all);
  EXPECT_NE(notes_of(document).find(scene + ": \"map 8192, disc of 32\" is nearer to the truth than 32 samples of izb "
                                            "(0.990 and 1.000 %)"),
            std::string::npos)
      << notes_of(document);
}

TEST(BenchSections, ShowThePapersNumbersOnlyBesideScenesOfOurs) {
  std::vector<Measured> all;
  for (Job job : shipped(Extent::quick, {"table1", "table2", "figure8"})) {
    job.scene.procedural.clear();  // somebody's villa.glb
    all.push_back({job, made_up_result(job)});
  }
  const json document = document_of(all);
  expect_sound(document);
  EXPECT_EQ(reason(cell(document, "table1-times-32", scene_label(all[0]), "theirs", "visibility", "paper")),
            "the paper has no such scene");
  EXPECT_EQ(reason(find_table(document, "table2")["rows"][0].back()), "not in the paper's table 2");
}

TEST(BenchSections, SoftwareIsMarked) {
  json made = made_up_conditions();
  const std::vector<Measured> all = measured(shipped(Extent::quick, {"table1"}));
  EXPECT_EQ(make_document(all, paper(), made, "c", "e")["software"], true);
  made["software"] = false;
  EXPECT_EQ(make_document(all, paper(), made, "c", "e")["software"], false);
}

/// Typing errors in the paper's numbers show in their sums.
TEST(PaperNumbers, StagesSumToTheTotals) {
  for (const auto& [name, scene] : paper()["table1"].items())
    for (const char* samples : {"32", "1"}) {
      const json& row = scene[samples];
      double sum = 0.0;
      for (const char* stage : {"gbuffer", "bounds", "build", "zcull", "visibility", "shade"})
        sum += row[stage].get<double>();
      if (name == "tentacles" && std::string(samples) == "32") {
        EXPECT_NEAR(sum, 60.6, 1e-9);
        EXPECT_EQ(row["frame"], 70.5);
        EXPECT_NE(paper()["note"].get<std::string>().find("60.6 ms and not to the 70.5"), std::string::npos);
        continue;
      }
      // Six numbers and their total, each rounded to 0.1.
      EXPECT_NEAR(sum, row["frame"].get<double>(), 7 * 0.05 + 1e-9) << name << " " << samples;
      // Millions and averages, rounded to 0.1 each.
      const double tests = row["tests_millions"], fragments = row["fragments_millions"];
      EXPECT_NEAR(row["tests_a_fragment"].get<double>(), tests / fragments,
                  0.05 + 0.05 * (1 + tests / fragments) / fragments + 1e-9)
          << name << " " << samples;
    }
}

TEST(PaperNumbers, SpeedsAreTestsOverTimes) {
  for (const auto& [name, row] : paper()["table2"].items()) {
    const double tests = row["tests_millions"], ms = row["speed_of_light_ms"];
    // What rounding to 0.1 of a quotient and its parts allows.
    EXPECT_NEAR(row["speed_of_light_millions_a_ms"].get<double>(), tests / ms,
                0.05 + 0.05 * (1 + tests / ms) / ms + 1e-9)
        << name;
  }
}

TEST(PaperNumbers, OurScenesStandForThem) {
  for (const auto& [name, scene] : paper()["table1"].items()) {
    if (name == "building" || name == "epic_citadel") continue;
    const std::vector<Job> jobs = shipped(Extent::complete, {"table1"});
    EXPECT_TRUE(std::any_of(jobs.begin(), jobs.end(), [&](const Job& j) { return j.scene.procedural == name; }))
        << name;
  }
}

}  // namespace
