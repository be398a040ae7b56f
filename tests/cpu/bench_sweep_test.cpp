// SPDX-License-Identifier: MIT
// Which jobs the sweeps take: sizes, scenes, options, for each extent and for what a person asks.
#include "app/bench/sweep.h"

#include <gtest/gtest.h>

#include "app/bench/measures.h"
#include "app/bench/truth_file.h"
#include "base/error.h"
#include "cpu/bench_results.h"
#include "cpu/gltf_writer.h"
#include "scene/procedural.h"

namespace {

namespace fs = std::filesystem;
using namespace izb::bench;
using namespace izb::test;
using izb::UsageError;

constexpr Extent extents[] = {Extent::quick, Extent::full, Extent::complete};

struct BenchSweep : testing::Test {
  BenchSweep() { unsetenv("IZB_SCENES"); }

  const TemporaryFolder folder;
  /// One experiment with every kind of value, under the name of each.
  json part = json::parse(R"({
    "measure": "times",
    "scenes": {"quick": ["town"], "full": ["town", "character"], "complete": ["town", "files"]},
    "triangles": {"quick": 5000, "full": 0},
    "size": {"quick": "32x16", "full": "64x32"},
    "frames": {"quick": 2, "complete": 9},
    "settings": {"fps": {"full": 24}, "peer": true},
    "configurations": [{"name": "one"}, {"name": "two", "technique": "shadow_map", "options": {"resolution": "512"}}]})");

  std::vector<Job> plan_of(SweepRequest request = {}, const json& views = json::object()) const {
    json sweeps;
    for (const char* name : experiment_names) sweeps[name] = part;
    if (request.experiments.empty()) request.experiments = {"table1"};
    return plan(sweeps, views, request, folder / "out");
  }
  std::vector<Job> plan_of_scenes(std::vector<std::string> scenes) const {
    SweepRequest request;
    request.scenes = std::move(scenes);
    return plan_of(request);
  }
  static std::vector<std::string> names(const std::vector<Job>& jobs) {
    std::vector<std::string> list;
    for (const Job& job : jobs) list.push_back(job.scene.name);
    return list;
  }
  fs::path scene(const std::string& name) const {
    const fs::path path = folder / name;
    fs::create_directories(path.parent_path());
    GltfWriter gltf;
    gltf.root["asset"]["extras"] = name;  // each its own bytes
    return write_file(path, gltf.glb());
  }
};

using Names = std::vector<std::string>;

TEST_F(BenchSweep, AValueThatAnExtentLacksIsTheNextSmallers) {
  SweepRequest request;
  request.extent = Extent::quick;
  const Job quick = plan_of(request).at(0);
  EXPECT_EQ(quick.size, "32x16");
  EXPECT_EQ(quick.frames, 2);
  EXPECT_EQ(quick.scene.triangles, 5000);
  EXPECT_TRUE(quick.settings["fps"].is_null());
  request.extent = Extent::full;
  const Job full = plan_of(request).at(0);
  EXPECT_EQ(full.size, "64x32");
  EXPECT_EQ(full.frames, 2);
  EXPECT_EQ(full.scene.triangles, 0);
  EXPECT_EQ(full.settings["fps"], 24);
  EXPECT_EQ(full.settings["peer"], true);
  request.extent = Extent::complete;
  const Job complete = plan_of(request).at(0);
  EXPECT_EQ(complete.size, "64x32");
  EXPECT_EQ(complete.frames, 9);
  EXPECT_EQ(complete.settings["fps"], 24);
}

TEST_F(BenchSweep, WhatThePersonAsksComesFirst) {
  SweepRequest request;
  request.size = "8x4", request.frames = 77, request.context = "egl";
  const Job job = plan_of(request).at(0);
  EXPECT_EQ(job.size, "8x4");
  EXPECT_EQ(job.frames, 77);
  EXPECT_EQ(job.context, "egl");
}

TEST_F(BenchSweep, ProceduralScenesNeverGetMoreTrianglesThanTheirOwn) {
  for (const izb::Procedural& p : izb::procedurals()) {
    for (const size_t triangles : {size_t(1000), p.triangles - 1, p.triangles, p.triangles + 1}) {
      part["triangles"] = triangles;
      const BenchScene its = plan_of_scenes({p.name}).at(0).scene;
      const bool fewer = p.any_triangles && triangles < p.triangles;
      EXPECT_EQ(its.triangles, fewer ? int(triangles) : 0) << p.name;
      EXPECT_EQ(its.procedural, p.name);
      EXPECT_EQ(its.frame.at("camera"), "main");
      EXPECT_EQ(its.file.find((folder / "out" / "scenes").string()), 0u) << its.file;
    }
  }
}

TEST_F(BenchSweep, FilesAreThoseOfTheFolderInTheEnvironment) {
  SweepRequest request;
  request.extent = Extent::complete;
  EXPECT_EQ(names(plan_of(request)), Names{"town"});
  scene("scenes/b.glb"), scene("scenes/a.gltf"), scene("scenes/deeper/c.glb");
  write_file(folder / "scenes/README.md", "no scene");
  fs::create_symlink("loop.glb", folder / "scenes/loop.glb");
  setenv("IZB_SCENES", (folder / "scenes").c_str(), 1);
  EXPECT_EQ(names(plan_of(request)), (Names{"town", "a", "b"}));
  EXPECT_EQ(names(plan_of_scenes({"b"})), Names{"b"});
  setenv("IZB_SCENES", (folder / "missing").c_str(), 1);
  EXPECT_THROW(plan_of(request), izb::Error);
  request.extent = Extent::full;
  EXPECT_EQ(plan_of(request).size(), 2u);
}

TEST_F(BenchSweep, ScenesThatAreNamedReplaceThoseOfTheSweep) {
  const fs::path a = scene("my scenes/ä 'b'.glb"), b = scene("my scenes/c.gltf");
  EXPECT_EQ(names(plan_of_scenes({a})), Names{"ä 'b'"});
  EXPECT_EQ(names(plan_of_scenes({folder / "my scenes"})), (Names{"c", "ä 'b'"}));
  EXPECT_EQ(names(plan_of_scenes({"villa", a})), (Names{"villa", "ä 'b'"}));
  const BenchScene file = plan_of_scenes({a}).at(0).scene;
  EXPECT_EQ(file.file, a.string());
  EXPECT_EQ(file.sha256.size(), 64u);
  EXPECT_TRUE(file.frame.empty() && file.procedural.empty());
}

TEST_F(BenchSweep, WhatIsNoSceneIsRefused) {
  fs::create_directory(folder / "empty");
  for (const std::string word : {"nonesuch", "nonesuch.glb", ""})
    EXPECT_THROW(plan_of_scenes({word}), UsageError) << word;
  EXPECT_THROW(plan_of_scenes({folder / "empty"}), UsageError);
}

TEST_F(BenchSweep, TheWorkingDirectoryDoesNotChangeWhatASweepMeans) {
  const fs::path before = fs::current_path();
  fs::current_path(folder / "");
  scene("town/a.glb"), scene("character");
  const std::vector<Job> jobs = plan_of();
  fs::current_path(before);
  EXPECT_EQ(names(jobs), (Names{"town", "character"}));
  for (const Job& job : jobs) EXPECT_FALSE(job.scene.procedural.empty());
}

TEST_F(BenchSweep, ScenesOfOneNameStayApart) {
  const fs::path a = scene("one/x.glb"), b = scene("two/x.glb"), c = scene("two/x.gltf"), d = scene("deep/two/x.glb"),
                 town = scene("town.glb");
  const std::vector<Job> jobs = plan_of_scenes({town, "town", a, b, c, d, b, folder / "one", "town"});
  EXPECT_EQ(names(jobs), (Names{"town", (folder / "").parent_path().filename() / "town.glb", "x", "two/x.glb",
                                "two/x.gltf", "two/x.glb (2)"}));
  EXPECT_EQ(jobs[0].scene.procedural, "town");
  std::set<fs::path> paths, files;
  for (const Job& job : jobs) {
    paths.insert(result_path(job, folder / "out"));
    files.insert(job.scene.file);
  }
  EXPECT_EQ(paths.size(), jobs.size());
  EXPECT_EQ(files.size(), jobs.size());
}

TEST_F(BenchSweep, FilesGetTheViewpointOfTheirName) {
  const json views{{"a", {{"eye", {1, 2, 3}}}}};
  SweepRequest request;
  request.scenes = {scene("a.glb"), scene("b.glb")};
  const std::vector<Job> jobs = plan_of(request, views);
  EXPECT_EQ(jobs.at(0).scene.frame.at("viewpoint"), "a");
  EXPECT_FALSE(jobs.at(1).scene.frame.contains("viewpoint"));
}

TEST_F(BenchSweep, AnAnimationPlaysWhereTheFileHoldsOne) {
  part["measure"] = "animation";
  part["procedural_frame"] = {{"animation", "path"}};
  GltfWriter moving;
  moving.root["animations"] = {{{"channels", json::array()}, {"samplers", json::array()}}};
  write_file(folder / "moving.glb", moving.glb());
  const std::vector<Job> jobs = plan_of_scenes({"town", folder / "moving.glb", scene("still.glb")});
  EXPECT_EQ(jobs.at(0).scene.frame.at("animation"), "path");
  EXPECT_FALSE(jobs.at(0).scene.frame.contains("time"));
  EXPECT_EQ(jobs.at(1).scene.frame.at("time"), "0");
  EXPECT_TRUE(frame_options(jobs.at(1)).plays());
  EXPECT_FALSE(jobs.at(1).scene.frame.contains("animation"));
  EXPECT_TRUE(jobs.at(2).scene.frame.empty());
}

TEST_F(BenchSweep, AChangeTakesTwoFrames) {
  part["measure"] = "temporal";
  SweepRequest request;
  request.frames = 1;
  EXPECT_EQ(plan_of(request).at(0).frames, 2);
  request.frames = 5;
  EXPECT_EQ(plan_of(request).at(0).frames, 5);
}

TEST_F(BenchSweep, EachConfigurationMayHaveAProcessOfItsOwn) {
  EXPECT_EQ(plan_of().at(0).configurations.size(), 2u);
  part["settings"]["process_each"] = true;
  const std::vector<Job> jobs = plan_of_scenes({"town"});
  ASSERT_EQ(jobs.size(), 2u);
  EXPECT_EQ(jobs[0].configurations.at(0).name, "one");
  EXPECT_EQ(jobs[1].configurations.at(0).name, "two");
  EXPECT_NE(result_path(jobs[0], "f"), result_path(jobs[1], "f"));
}

TEST_F(BenchSweep, ExperimentsComeInTheOrderOfTheTablesAndOnce) {
  SweepRequest request;
  request.experiments = {"memory", "table1", "memory"};
  request.scenes = {"town"};
  std::vector<std::string> order;
  for (const Job& job : plan_of(request)) order.push_back(job.experiment);
  EXPECT_EQ(order, (Names{"table1", "memory"}));
}

/// The sweeps as they are shipped.
TEST_F(BenchSweep, EveryShippedSweepCanRun) {
  scene("scenes/somebody's file.glb");
  setenv("IZB_SCENES", (folder / "scenes").c_str(), 1);
  const json sweeps = bench_data("sweeps.json"), views = bench_data("views.json");
  std::set<std::string> names(std::begin(experiment_names), std::end(experiment_names));
  for (const auto& [name, sweep] : sweeps.items()) EXPECT_TRUE(names.contains(name)) << name;
  const std::vector<std::string> measures = measure_names();
  for (const Extent extent : extents) {
    SweepRequest request;
    request.extent = extent;
    const std::vector<Job> jobs = plan(sweeps, views, request, folder / "out");
    std::set<std::string> planned;
    std::set<fs::path> paths;
    for (const Job& job : jobs) {
      SCOPED_TRACE(job.experiment + " " + job.part + " " + job.scene.name);
      planned.insert(job.experiment);
      EXPECT_TRUE(paths.insert(result_path(job, "f")).second);
      EXPECT_NE(std::find(measures.begin(), measures.end(), job.measure), measures.end());
      EXPECT_NO_THROW(frame_options(job));
      EXPECT_GE(job.frames, 1);
      EXPECT_EQ(truth_rays(job) % 16, 0);
      for (const auto& [key, value] : job.settings.items()) EXPECT_FALSE(value.is_null()) << key;
      std::set<std::string> configurations;
      for (const Configuration& c : job.configurations) {
        EXPECT_TRUE(configurations.insert(c.name).second) << c.name;
        EXPECT_NO_THROW(make_technique(c)) << c.name;
        EXPECT_NO_THROW(izb::parse_size(c.size.empty() ? job.size : c.size));
      }
      EXPECT_FALSE(configurations.empty());
    }
    EXPECT_EQ(planned, names);
    const bool has_file =
        std::any_of(jobs.begin(), jobs.end(), [](const Job& j) { return j.scene.name == "somebody's file"; });
    EXPECT_EQ(has_file, extent != Extent::quick);
  }
}

/// Truths are files that others may lie beside.
TEST_F(BenchSweep, ATruthIsOfOneSceneViewAndSize) {
  part["settings"] = {{"truth_rays", 64}};
  const Job job = plan_of_scenes({"town"}).at(0);
  const fs::path path = truth_path(job, "f");
  const auto differs = [&](auto&& change) {
    Job other = job;
    change(other);
    return truth_path(other, "f") != path;
  };
  EXPECT_FALSE(differs([](Job& j) { j.configurations.clear(), j.frames = 9; }));
  EXPECT_TRUE(differs([](Job& j) { j.size = "9x9"; }));
  EXPECT_TRUE(differs([](Job& j) { j.settings["truth_rays"] = 128; }));
  EXPECT_TRUE(differs([](Job& j) { j.scene.sha256 = "1"; }));
  EXPECT_TRUE(differs([](Job& j) { j.scene.file = "/elsewhere.glb"; }));
  EXPECT_TRUE(differs([](Job& j) { j.scene.frame["camera"] = "other"; }));
}

TEST_F(BenchSweep, ATruthsFramesAreLargeWhereTheyMayBe) {
  part["settings"] = {{"truth_rays", 64}};
  Job job = plan_of_scenes({"town"}).at(0);
  const auto after = [&](const std::string& word) {
    const std::vector<std::string> words = truth_command(job, "f");
    return *(std::find(words.begin(), words.end(), word) + 1);
  };
  EXPECT_EQ(after("--camera"), "main");
  EXPECT_EQ(after("--size"), "512x256");
  EXPECT_EQ(after("--supersample"), "1");
  job.settings["truth_rays"] = 32;
  EXPECT_EQ(after("--size"), "256x128");
  EXPECT_EQ(after("--supersample"), "2");
  job.settings["truth_rays"] = 128;
  job.size = "640x360";
  EXPECT_EQ(after("--size"), "2560x1440");
  EXPECT_EQ(after("--supersample"), "8");
}

}  // namespace
