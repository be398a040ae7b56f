// SPDX-License-Identifier: MIT
// What izb bench writes, what it refuses, and how one bad scene leaves the others.
#include <gtest/gtest.h>

#include "app/results.h"
#include "cli/bench_program.h"
#include "image/png.h"

namespace {

using namespace izb::test;
using Rows = std::vector<std::vector<std::string>>;

/// RFC 4180.
Rows read_csv(const fs::path& path) {
  const std::string text = izb::read_text_file(path);
  Rows rows;
  std::vector<std::string> row{""};
  bool quoted = false;
  for (size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted) {
      if (c != '"')
        row.back() += c;
      else if (i + 1 < text.size() && text[i + 1] == '"')
        row.back() += text[++i];
      else
        quoted = false;
    } else if (c == '"') {
      quoted = true;
    } else if (c == ',') {
      row.emplace_back();
    } else if (c == '\n') {
      rows.push_back(std::exchange(row, {""}));
    } else if (c != '\r') {
      row.back() += c;
    }
  }
  return rows;
}

double number(const std::string& text) {
  size_t used = 0;
  const double value = std::stod(text, &used);
  EXPECT_EQ(used, text.size()) << text;
  return value;
}

/// Every experiment with the least that it needs.
json all_sweeps() {
  const json izb_32{{"name", "32 samples, defaults"}},
      izb_1{{"name", "1 sample, defaults"}, {"options", {{"spp", "1"}}}};
  const auto called = [](json configuration, const std::string& name, const json& more = json::object()) {
    configuration["name"] = name;
    configuration.update(more);
    return configuration;
  };
  const json rays_1{{"name", ""}, {"technique", "ray_traced"}, {"options", {{"spp", "1"}}}};
  json all;
  all["table1"] = small_part("times", {izb_32, izb_1});
  all["table1"]["settings"] = {{"peer", true}, {"pictures", true}};
  all["table2"] = small_part("speed_of_light", {called(izb_32, "32 samples")});
  all["figure10"] = small_part("beams", {izb_32});
  json size = small_part("times", {called(izb_1, "32 samples, 1080p", {{"size", "32x24"}}),
                                   called(izb_1, "32 samples, 2160p", {{"size", "64x48"}})}),
       moving = small_part("animation", {called(izb_1, "1 sample")});
  size["part"] = "resolution", moving["part"] = "animation";
  moving["procedural_frame"] = {{"camera", "path"}, {"animation", "path"}, {"loop", "on"}};
  moving["settings"] = {{"fps", 1}};
  all["figure8"] = {size, moving};
  all["figure9"] =
      small_part("times", {called(izb_1, "32 samples, 64", {{"options", {{"grid", "64"}, {"spp", "1"}}}})});
  all["ablations"] = small_part("times", {called(izb_1, "defaults"), called(izb_1, "--spp 1")});
  all["memory"] = small_part("times", {map_configuration("shadow map 2048")});
  all["memory"]["settings"] = {{"process_each", true}};
  json camera = small_part("temporal",
                           {called(rays_1, "truth", {{"notes", {{"supersample", 4}}}}), map_configuration("map")}),
       light = camera;
  camera["part"] = "camera", light["part"] = "light";
  camera["settings"] = {{"step_px", 0.5}}, light["settings"] = {{"step_deg", 3}};
  all["temporal"] = {camera, light};
  all["peers"] = small_part(
      "quality", {called(izb_32, "izb, 32 samples", {{"notes", {{"role", "ours"}}}}),
                  called(rays_1, "rays, 32 samples", {{"options", json::object()}, {"notes", {{"role", "rays"}}}}),
                  map_configuration("map 2048, unfiltered")});
  all["peers"]["settings"] = {{"truth_rays", 64}};
  return all;
}

constexpr size_t all_jobs = 11;

struct BenchRun : BenchProgram {
  BenchRun() { set_sweeps(all_sweeps()); }

  fs::path scene(const std::string& name, const GltfWriter& gltf = roof_over_floor()) const {
    fs::create_directories((folder / name).parent_path());
    return write_file(folder / name, gltf.glb());
  }
  /// Whether a driver complained in any job: GL errors are in the logs.
  void expect_quiet_logs() const {
    for (const fs::path& log : files(".log"))
      EXPECT_EQ(izb::read_text_file(log).find("warning: GL:"), std::string::npos) << log;
  }
};

TEST_F(BenchRun, WritesResultsTablesAndAReport) {
  const Outcome outcome = bench({"--frames", "3", "--scenes", "town", "--quick"}, {{{"IZB_GL_DEBUG", "1"}}, false});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(measured(outcome).size(), all_jobs);
  EXPECT_TRUE(outcome.prints("wrote " + (out / "report.html").string())) << outcome.out;
  expect_complete(all_jobs);
  expect_quiet_logs();

  // Medians are of the samples, of which there is one a frame; frames alternate and each round begins with another.
  const json result = read_json(out / "runs/table1/town.json");
  ASSERT_EQ(result["configurations"].size(), 2u);
  std::vector<std::vector<double>> started;
  for (const json& c : result["configurations"]) {
    SCOPED_TRACE(c["name"]);
    ASSERT_EQ(c["frame_samples"].size(), 3u);
    EXPECT_EQ(c["frame_ms"], izb::median(c["frame_samples"]));
    EXPECT_EQ(c["stages"].size(), 7u);
    for (const json& stage : c["stages"]) {
      EXPECT_EQ(stage["samples"].size(), 3u);
      EXPECT_EQ(stage["gpu_ms"], izb::median(stage["samples"]));
    }
    started.push_back(c["frame_started_ms"]);
  }
  for (size_t round = 1; round < 3; ++round) {
    EXPECT_LT(std::max(started[0][round - 1], started[1][round - 1]), std::min(started[0][round], started[1][round]));
    EXPECT_NE(started[0][round] < started[1][round], started[0][round - 1] < started[1][round - 1]);
  }
  const json& peer = result["peer"]["low"];
  EXPECT_EQ(peer["trace_samples"].size(), 3u);
  EXPECT_EQ(peer["trace_ms"], izb::median(peer["trace_samples"]));

  // Tables: a line a row, the numbers of the results.
  const Rows defaults = read_csv(out / "table1-defaults.csv");
  ASSERT_EQ(defaults.size(), 2u);
  ASSERT_EQ(defaults[0].size(), defaults[1].size());
  EXPECT_EQ(defaults[0][0], "scene");
  EXPECT_EQ(defaults[0][2], "32 samples: frame (ms)");
  EXPECT_EQ(number(defaults[1][2]), result["configurations"][0]["frame_ms"].get<double>());
  const Rows stages = read_csv(out / "table1-times-32.csv");
  EXPECT_EQ(stages[0][3], "gbuffer: theirs, paper (ms)");
  EXPECT_EQ(number(stages[1][3]), 1.0);
  EXPECT_EQ(stages[1][2], "n/a: not part of this run");
  for (const fs::path& path : files(".csv")) {
    const Rows rows = read_csv(path);
    EXPECT_GE(rows.size(), 2u) << path;
    for (const auto& row : rows) {
      EXPECT_EQ(row.size(), rows[0].size()) << path;
      for (const std::string& cell : row) EXPECT_FALSE(cell.empty()) << path;
    }
  }
  const Rows flicker = read_csv(out / "temporal-light.csv");
  ASSERT_EQ(flicker.size(), 3u);
  EXPECT_GT(number(flicker[1][3]), 0.0) << "the light turned, so that shadows moved";
  EXPECT_EQ(number(flicker[1][4]), 0.0);
  EXPECT_GT(number(flicker[2][4]), 0.0);
  // Masks are compared where samples stand at the same points.
  const json peers = read_json(out / "runs/peers/town.json")["configurations"];
  EXPECT_GT(peers[0]["against_rays"]["bits"], 100);
  EXPECT_LT(peers[0]["against_rays"]["differing_percent"], 10.0);
  EXPECT_EQ(peers[1]["against_rays"]["differing_percent"], 0.0);
  EXPECT_FALSE(peers[2].contains("against_rays"));
  const json light = read_json(out / "runs/table2/town.json")["configurations"][0]["speed_of_light"];
  EXPECT_EQ(light["same_mask"], true);
  EXPECT_EQ(light["ms"], izb::median(light["samples_ms"]));

  const json report = read_json(out / "report.json");
  EXPECT_EQ(report["sections"].size(), 9u);
  EXPECT_NE(report["facts"].dump().find("bench all -o"), std::string::npos);
  EXPECT_NE(izb::read_text_file(out / "report.html").find("data:image/png;base64,"), std::string::npos);
  std::set<fs::path> ids;
  for (const json& section : report["sections"])
    for (const json& table : section["tables"]) ids.insert(out / (table["id"].get<std::string>() + ".csv"));
  const std::vector<fs::path> tables = files(".csv");
  EXPECT_EQ(std::set<fs::path>(tables.begin(), tables.end()), ids);
}

TEST_F(BenchRun, PicturesOfTheReportAreReducedByAWholeNumber) {
  json sweeps;
  sweeps["table1"] = small_part("times", {{{"name", "1 sample"}, {"options", {{"spp", "1"}}}}});
  sweeps["table1"]["settings"] = {{"pictures", true}};
  set_sweeps(sweeps);
  const Outcome outcome = bench({"--scenes", scene("roof.glb"), "--size", "1300x650"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  for (const char* word : {"picture", "tests", "lists"}) {
    const izb::Image8 picture = izb::read_png(out / "images" / (std::string("table1-roof-") + word + ".png"));
    EXPECT_EQ(picture.width_px, 650) << word;
    EXPECT_EQ(picture.height_px, 325) << word;
  }
}

TEST_F(BenchRun, ASceneWithNothingInViewIsMeasured) {
  GltfWriter sky = roof_over_floor();
  for (json& node : sky.root["nodes"])
    if (node.contains("camera")) node["rotation"] = {0.7071067812, 0, 0, 0.7071067812};  // straight up
  const Outcome outcome = bench({"--scenes", scene("sky.glb", sky)});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  expect_complete(all_jobs);
  EXPECT_EQ(read_json(out / "runs/table1/sky.json")["configurations"][0]["counts"]["receivers"], 0);
  // It has no animation either, which its row says.
  EXPECT_EQ(read_csv(out / "figure8-animation.csv")[1][3], "n/a: the scene has no animation");
}

TEST_F(BenchRun, ABadSceneIsARowAndTheOthersAreThere) {
  json sweeps = quick_sweeps();
  sweeps.erase("peers");
  sweeps["memory"]["configurations"].erase(1);
  set_sweeps(sweeps);
  const std::string bad = "bad scene 'ü' \"x\"";
  write_file(folder / (bad + ".glb"), "no scene");
  GltfWriter lamps = roof_over_floor();  // of several lights one is taken, and said
  json& lights = lamps.root["extensions"]["KHR_lights_punctual"]["lights"];
  lights.push_back({{"name", "a lamp"}, {"type", "point"}});
  json lamp{{"translation", {0, 3, 0}}};
  lamp["extensions"]["KHR_lights_punctual"]["light"] = 1;
  lamps.add_root(lamp);
  const fs::path first = scene("one/roof.glb"), second = scene("two/roof.glb", lamps);
  const Outcome outcome = bench({"--scenes", folder / (bad + ".glb"), first, second});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_TRUE(outcome.says("1 of 3 jobs failed: the report says why")) << outcome.err;
  expect_whole();
  const Rows rows = read_csv(out / "memory.csv");
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_EQ(rows[1][0], bad);
  EXPECT_TRUE(rows[1][3].starts_with("n/a: cannot load '" + (folder / (bad + ".glb")).string())) << rows[1][3];
  EXPECT_EQ(rows[2][0], "roof");
  EXPECT_EQ(rows[3][0], "two/roof.glb");
  for (const int row : {2, 3}) EXPECT_GT(number(rows[row][3]), 0.0);
  EXPECT_EQ(files(".json").size(), 4u);
}

TEST_F(BenchRun, AConfigurationThatCannotBeMeasuredIsSaid) {
  json sweeps;
  sweeps["table1"] = small_part("times", {{{"name", "1 sample"}, {"options", {{"spp", "1"}}}},
                                          {{"name", "too large"}, {"options", {{"grid", "16384"}}}}});
  set_sweeps(sweeps);
  const Outcome outcome =
      run_program(words({"--scenes", scene("roof.glb")}), {{{"IZB_MEMORY_BYTES", "1000000000"}}, false});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_TRUE(outcome.says("1 configuration could not be measured: the report says why")) << outcome.err;
  expect_whole();
  const json both = read_json(out / "runs/table1/roof.json")["configurations"];
  EXPECT_TRUE(both[0].contains("frame_ms"));
  EXPECT_TRUE(both[1].contains("failed"));
}

TEST_F(BenchRun, SaysWhatItWouldDoWithoutDoingIt) {
  const Outcome outcome = run_program({"env", "-C", folder / "", program, "bench", "all", "--list"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(outcome.prints("figure8 resolution: town, 32x24, 2 frames, 2 configurations")) << outcome.out;
  EXPECT_TRUE(outcome.prints("  32 samples, 2160p: --technique izb --spp 1 --size 64x48")) << outcome.out;
  EXPECT_EQ(names_in(folder / ""), (std::vector<std::string>{"bin", "share"}));
  const Outcome both = run_program({program, "bench", "memory", "all", "--list"});
  EXPECT_EQ(both.out, outcome.out);
}

TEST_F(BenchRun, MistakesAreRefusedBeforeAnythingIsWritten) {
  fs::create_directory(folder / "empty");
  const auto refused = [&](std::vector<std::string> more, const std::string& sentence) {
    more.insert(more.begin(), {program, "bench"});
    const Outcome outcome = run_program(more);
    EXPECT_EQ(outcome.code, 2) << outcome.err;
    EXPECT_EQ(outcome.error_lines().size(), 1u) << outcome.err;
    EXPECT_TRUE(outcome.says(sentence)) << outcome.err;
    EXPECT_FALSE(fs::exists(out));
  };
  refused({}, "WHAT");
  refused({"table3", "-o", out}, "table3");
  refused({"all"}, "give -o FOLDER");
  refused({"all", "--quick", "--complete", "-o", out}, "--quick and --complete exclude each other");
  for (const char* size : {"64", "64x", "0x4", "64x48x2", "x"}) refused({"all", "--size", size, "-o", out}, "--size");
  refused({"all", "--frames", "-1", "-o", out}, "--frames");
  refused({"all", "--frames", "x", "-o", out}, "--frames");
  refused({"all", "--time-limit", "0", "-o", out}, "--time-limit");
  refused({"all", "--context", "nonesuch", "-o", out}, "--context");
  refused({"all", "-o", out, "--scenes", folder / "missing.glb"}, "is no file, no folder and no procedural scene");
  refused({"all", "-o", out, "--scenes", folder / "empty"}, "holds no .glb and no .gltf");
  set_sweeps({});
  refused({"all", "-o", out}, "nothing to measure");
}

TEST_F(BenchRun, WhatCannotBeReadOrWrittenIsOneSentence) {
  const auto fails = [&](const std::vector<std::string>& words, const std::string& sentence,
                         const RunOptions& options = {}) {
    const Outcome outcome = run_program(words, options);
    EXPECT_EQ(outcome.code, 1) << outcome.err;
    EXPECT_EQ(outcome.error_lines().size(), 1u) << outcome.err;
    EXPECT_TRUE(outcome.says(sentence)) << outcome.err;
  };
  write_file(folder / "file", "x");
  fails({program, "bench", "all", "-o", folder / "file"}, "cannot make the folder");
  fails({program, "bench", "all", "-o", folder / "file/below"}, "cannot make the folder");
  fs::create_directory(folder / "locked");
  fs::permissions(folder / "locked", fs::perms::owner_read | fs::perms::owner_exec);
  fs::permissions(folder / "", fs::perms::owner_all | fs::perms::others_read | fs::perms::others_exec);
  fails({program, "bench", "all", "-o", folder / "locked/out"}, "Permission denied", {{}, true});

  json sweeps = quick_sweeps();
  sweeps["memory"]["scenes"] = {"files"};
  set_sweeps(sweeps);
  fails(words(), "cannot read the folder", {{{"IZB_SCENES", folder / "nonesuch"}}, false});
  write_file(folder / "share/izb/paper.json", "{");
  fails(words(), "is not the JSON that it should be");
  fs::remove(folder / "share/izb/paper.json");
  fs::create_directory(folder / "share/izb/paper.json");
  fails(words(), "cannot read");
  EXPECT_FALSE(fs::exists(out));
}

/// Whatever a file may not exceed: an old report stays as it was.
TEST_F(BenchRun, AFileThatCannotGrowEndsTheRun) {
  set_sweeps(quick_sweeps());
  ASSERT_EQ(bench().code, 0);
  const std::string before = izb::read_text_file(out / "report.html");
  ASSERT_GT(before.size(), size_t(40) << 10);
  fs::remove(out / "runs/memory/town.shadow_map_2048.json");
  std::vector<std::string> limited{"bash", "-c", "trap '' XFSZ; ulimit -f 40; exec \"$@\"", "bash"};
  for (const std::string& word : words({"--resume"})) limited.push_back(word);
  Outcome outcome = run_program(limited);
  EXPECT_EQ(outcome.code, 1) << outcome.err;
  EXPECT_TRUE(outcome.error_lines().back().starts_with("izb: cannot write")) << outcome.err;
  EXPECT_EQ(izb::read_text_file(out / "report.html"), before);
  expect_whole();
  outcome = bench({"--resume"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  expect_complete(3);
}

}  // namespace
