// SPDX-License-Identifier: MIT
// A job as text and back, and which results are of the same work.
#include "app/bench/job.h"

#include <gtest/gtest.h>

#include "app/bench/machine.h"
#include "app/bench/scene_file.h"
#include "base/error.h"
#include "base/json_text.h"
#include "cpu/bench_results.h"
#include "cpu/gltf_writer.h"

namespace {

namespace fs = std::filesystem;
using namespace izb::bench;
using namespace izb::test;
using izb::UsageError;

Job example() {
  Job job;
  job.experiment = "figure8", job.part = "animation", job.measure = "animation";
  job.scene = {"a \"b\" ü", "/x/a.glb", "", 0, "0123", {{"camera", "main"}, {"time", "0"}}};
  job.size = "64x48", job.context = "egl", job.frames = 7;
  job.configurations = {{"one", "izb", "paper", "32x16", {{"spp", "1"}}, {{"role", "ours"}, {"supersample", 32}}},
                        {"two", "shadow_map", "", "", {}, json::object()}};
  job.settings = {{"fps", 2.5}, {"peer", true}};
  return job;
}

TEST(BenchJob, ComesBackFromItsText) {
  const Job job = example();
  const Job back = job_from(json::parse(izb::json_text(to_json(job))));
  EXPECT_EQ(to_json(back), to_json(job));
  EXPECT_EQ(back.scene.frame, job.scene.frame);
  EXPECT_EQ(back.configurations[0].options, job.configurations[0].options);
  EXPECT_EQ(back.configurations[0].notes["supersample"], 32);
  EXPECT_EQ(back.settings["fps"], 2.5);
  EXPECT_THROW(job_from(json::parse("{}")), json::exception);
}

TEST(BenchJob, IsTheSameWorkWhereverItsFileLies) {
  const Job job = example();
  Job moved = job;
  moved.scene.file = "/y/a.glb";
  EXPECT_TRUE(same_work(job, moved));
  const auto differs = [&](auto&& change) {
    Job other = job;
    change(other);
    return !same_work(job, other);
  };
  EXPECT_TRUE(differs([](Job& j) { j.frames = 8; }));
  EXPECT_TRUE(differs([](Job& j) { j.size = "64x49"; }));
  EXPECT_TRUE(differs([](Job& j) { j.scene.sha256 = "0124"; }));
  EXPECT_TRUE(differs([](Job& j) { j.scene.frame["time"] = "1"; }));
  EXPECT_TRUE(differs([](Job& j) { j.configurations[0].options["spp"] = "32"; }));
  EXPECT_TRUE(differs([](Job& j) { j.configurations[1].name = "three"; }));
  EXPECT_TRUE(differs([](Job& j) { j.settings["fps"] = 3; }));
}

TEST(BenchJob, ItsOptionsAreTheCommandLines) {
  const Job job = example();
  EXPECT_EQ(job.configurations[0].command_line(), "--technique izb --preset paper --spp 1");
  EXPECT_EQ(make_technique(job.configurations[0])->options().to_json()["spp"], "1");
  const izb::FrameOptions options = frame_options(job);
  EXPECT_EQ(options.size, "64x48");
  EXPECT_EQ(options.camera, "main");
  EXPECT_EQ(options.time_s, 0.0);
  EXPECT_EQ(options.context, "egl");

  Configuration unknown = job.configurations[0];
  unknown.options["warp"] = "9";
  EXPECT_THROW(make_technique(unknown), UsageError);
  unknown.options = {{"spp", "31"}};
  EXPECT_THROW(make_technique(unknown), UsageError);
  Job odd = job;
  odd.scene.frame["warp"] = "9";
  EXPECT_THROW(frame_options(odd), UsageError);
}

TEST(BenchJob, NamesStayApartAsFiles) {
  EXPECT_EQ(file_word("powerplant-2_b"), "powerplant-2_b");
  EXPECT_EQ(file_word("straße"), "straße");
  const std::vector<std::string> names{"a b",
                                       "a_b",
                                       "a.b",
                                       "a/b",
                                       "a'b",
                                       "a\"b",
                                       "",
                                       ".",
                                       std::string(300, 'x'),
                                       std::string(301, 'x'),
                                       std::string(99, 'x') + "üüü"};
  std::set<std::string> words;
  for (const std::string& name : names) {
    const std::string word = file_word(name);
    EXPECT_TRUE(words.insert(word).second) << name;
    EXPECT_FALSE(word.empty());
    EXPECT_LT(word.size(), 128u);
    EXPECT_EQ(word.find_first_of("/ .'\""), std::string::npos) << word;
    // A character is cut nowhere: what is no UTF-8 would not survive as JSON.
    EXPECT_EQ(json::parse(izb::json_text(json(word))), json(word));
  }
}

TEST(BenchMachine, ConditionsAreCommitMachineAndDriverAndNotTheDate) {
  const json made = made_up_conditions();
  json other = made;
  other["date"] = "2026-01-01T00:00:00Z";
  EXPECT_TRUE(same_conditions(made, other));
  for (const char* pointer : {"/version", "/machine/processor", "/machine/memory_bytes", "/gl/renderer", "/gl/version",
                              "/gl/context", "/software", "/embree"}) {
    other = made;
    other[json::json_pointer(pointer)] = "another";
    EXPECT_FALSE(same_conditions(made, other)) << pointer;
  }
  EXPECT_FALSE(same_conditions(json(), made));
  EXPECT_FALSE(same_conditions("x", "x"));
}

TEST(BenchSceneFile, TheDigestIsOfAllThatTheSceneIsMadeOf) {
  const TemporaryFolder folder;
  const std::string text = R"({"asset": {"version": "2.0"}, "animations": [{}],
    "buffers": [{"uri": "a%20b.bin", "byteLength": 1}], "images": [{"uri": "data:image/png;base64,AA=="}]})";
  const fs::path scene = write_file(folder / "s.gltf", text);
  const SceneFile without = look_into(scene);
  write_file(folder / "a b.bin", "x");
  const SceneFile with = look_into(scene);
  write_file(folder / "a b.bin", "y");
  const SceneFile changed = look_into(scene);
  EXPECT_TRUE(without.animated && with.animated);
  EXPECT_NE(without.sha256, with.sha256);
  EXPECT_NE(with.sha256, changed.sha256);
  write_file(folder / "a b.bin", "x");
  EXPECT_EQ(look_into(scene).sha256, with.sha256);
  write_file(folder / "s.gltf", text + " ");
  EXPECT_NE(look_into(scene).sha256, with.sha256);
}

TEST(BenchSceneFile, SeesAnimationsOfAGlbAndBearsWhatIsNoScene) {
  const TemporaryFolder folder;
  GltfWriter gltf;
  EXPECT_FALSE(look_into(write_file(folder / "a.glb", gltf.glb())).animated);
  gltf.root["animations"] = {{{"channels", json::array()}, {"samplers", json::array()}}};
  EXPECT_TRUE(look_into(write_file(folder / "a.glb", gltf.glb())).animated);
  std::set<std::string> digests;
  const std::string too_long = "glTF" + std::string(8, '\2') + std::string(4, '\xff') + "JSON{}";
  for (const std::string& bytes : {std::string(), std::string("glTF"), std::string("[]"), too_long,
                                   std::string(R"({"buffers": 3, "images": [4, {"uri": 5}]})")})
    digests.insert(look_into(write_file(folder / "a.glb", bytes)).sha256);
  EXPECT_EQ(digests.size(), 5u);
  EXPECT_THROW(look_into(folder / "missing.glb"), izb::Error);
}

}  // namespace
