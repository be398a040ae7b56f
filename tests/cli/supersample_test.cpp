// SPDX-License-Identifier: MIT
// Supersampled frames as a person makes them: files, interruptions, and what goes with what.
#include <gtest/gtest.h>

#include <csignal>
#include <nlohmann/json.hpp>
#include <thread>

#include "cli/run_program.h"
#include "cli/small_scenes.h"
#include "image/exr.h"

namespace {

namespace fs = std::filesystem;
using namespace izb::test;
using izb::Image;

struct SupersampledFrame : testing::Test {
  const TemporaryFolder folder;
  const fs::path scene = write_file(folder / "roof.glb", roof_over_floor().glb());

  std::vector<std::string> words(int frames, const fs::path& output, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> all{"render", scene, "--size", "48x36", "--grid", "128", "--spp", "1"};
    all.insert(all.end(), {"--supersample", std::to_string(frames), "-o", output});
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  Outcome render(int frames, const fs::path& output, const std::vector<std::string>& more = {}) const {
    return izb::test::izb(words(frames, output, more));
  }
  static int held(const fs::path& path) {
    return std::stoi(std::get<std::string>(izb::read_exr_attributes(path).at("izb.supersample")));
  }
  static void expect_same(const fs::path& a, const fs::path& b) {
    const Image one = izb::read_exr(a), other = izb::read_exr(b);
    ASSERT_EQ(one.channels.size(), other.channels.size());
    for (const izb::Channel& channel : one.channels) {
      ASSERT_TRUE(other.find(channel.name)) << channel.name;
      EXPECT_EQ(channel.data, other.find(channel.name)->data) << channel.name;
    }
  }
};

TEST_F(SupersampledFrame, WritesMeansSharesAndSaysHowMany) {
  const Outcome outcome = render(16, folder / "a.exr", {"--json", folder / "a.json", "--preview", folder / "a.png"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(outcome.prints("supersample")) << outcome.out;
  EXPECT_TRUE(fs::exists(folder / "a.png"));
  const Image image = izb::read_exr(folder / "a.exr");
  EXPECT_EQ(held(folder / "a.exr"), 16);
  EXPECT_TRUE(image.attributes.contains("worldToNDC"));
  size_t soft = 0;
  for (const char* name : {"surface", "receiver", "lit"})
    for (const float share : image.floats(name)) {
      EXPECT_EQ(share * 16.0f, std::floor(share * 16.0f)) << name;
      soft += share > 0.0f && share < 1.0f;
    }
  EXPECT_GT(soft, 50u);
  for (size_t i = 0; i < image.pixel_count(); ++i) {
    EXPECT_LE(image.floats("lit")[i], image.floats("receiver")[i]);
    EXPECT_LE(image.floats("receiver")[i], image.floats("surface")[i]);
  }
  for (const char* absent : {"mask", "depth", "list_length"}) EXPECT_FALSE(image.find(absent)) << absent;
  const json its = read_json(folder / "a.json");
  EXPECT_EQ(its["supersample"], 16);
  EXPECT_EQ(its["frames_rendered"], 16);
  EXPECT_EQ(its["options"]["supersample"], 16);
  EXPECT_GT(its["frame_ms"].get<double>(), 0.0);
  std::set<std::string> stages;
  for (const json& stage : its["stages"]) stages.insert(stage["name"].get<std::string>());
  EXPECT_TRUE(stages.contains("gbuffer") && stages.contains("accumulate"));
  EXPECT_FALSE(its.contains("mask_hash"));
  EXPECT_EQ(its["lights"][0]["name"], "noon");
}

TEST_F(SupersampledFrame, OfSeveralLightsEachHasItsShares) {
  ASSERT_EQ(render(3, folder / "a.exr", {"--light", "all", "--sun", "40,50"}).code, 0);
  const Image image = izb::read_exr(folder / "a.exr");
  EXPECT_NE(image.floats("lit.noon"), image.floats("lit.sun"));
  EXPECT_NO_THROW(image.floats("receiver.sun"));
}

TEST_F(SupersampledFrame, ResumedIsTheSameFile) {
  ASSERT_EQ(render(13, folder / "whole.exr").code, 0);
  ASSERT_EQ(render(5, folder / "part.exr").code, 0);
  const Outcome more = render(13, folder / "part.exr", {"--resume", "on", "--json", folder / "part.json"});
  ASSERT_EQ(more.code, 0) << more.err;
  EXPECT_EQ(read_json(folder / "part.json")["frames_rendered"], 8);
  EXPECT_EQ(held(folder / "part.exr"), 13);
  expect_same(folder / "whole.exr", folder / "part.exr");
  const auto written = fs::last_write_time(folder / "part.exr");
  const Outcome again = render(13, folder / "part.exr", {"--resume", "on", "--json", folder / "part.json"});
  EXPECT_EQ(again.code, 0);
  EXPECT_TRUE(again.says("all 13 frames were there already")) << again.err;
  EXPECT_EQ(fs::last_write_time(folder / "part.exr"), written);
  // What else is asked for comes from the sums.
  const Outcome preview = render(13, folder / "part.exr", {"--resume", "on", "--preview", folder / "part.png"});
  EXPECT_EQ(preview.code, 0) << preview.err;
  EXPECT_TRUE(fs::exists(folder / "part.png"));
  expect_same(folder / "whole.exr", folder / "part.exr");
}

TEST_F(SupersampledFrame, AnInterruptedRunLeavesItsLastCheckpoint) {
  const fs::path path = folder / "long.exr";
  std::vector<std::string> all = words(100'000, path, {"--checkpoint", "0"});
  all.insert(all.begin(), IZB_PROGRAM);
  std::vector<char*> arguments;
  for (std::string& word : all) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const pid_t child = fork();
  if (child == 0) {
    execv(arguments[0], arguments.data());
    _exit(127);
  }
  for (int i = 0; i < 600 && !fs::exists(path); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(100));
  kill(child, SIGINT);
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGINT) << status;
  EXPECT_EQ(names_in(folder / ""), (std::vector<std::string>{"long.exr", "roof.glb"}));
  const int frames = held(path);
  ASSERT_GE(frames, 1);
  const Outcome more = render(frames + 3, path, {"--resume", "on"});
  ASSERT_EQ(more.code, 0) << more.err;
  ASSERT_EQ(render(frames + 3, folder / "whole.exr").code, 0);
  expect_same(folder / "whole.exr", path);
}

TEST_F(SupersampledFrame, WhatIsOfAnotherFrameIsRefused) {
  ASSERT_EQ(render(4, folder / "a.exr").code, 0);
  const auto expect_refused = [&](const Outcome& outcome, const std::string& sentence) {
    EXPECT_EQ(outcome.code, 1);
    EXPECT_TRUE(outcome.says(sentence)) << outcome.err;
    EXPECT_EQ(held(folder / "a.exr"), 4);
  };
  const char* const other = "was rendered with other options or of another scene";
  expect_refused(render(6, folder / "a.exr", {"--resume", "on", "--sun", "20,30"}), other);
  expect_refused(render(6, folder / "a.exr", {"--resume", "on", "--spp", "32"}), other);
  expect_refused(render(3, folder / "a.exr", {"--resume", "on"}), "holds 4 frames already, more than --supersample 3");
  // A frame through the centres is no sum, nor the other way round.
  ASSERT_EQ(
      izb::test::izb({"render", scene, "--size", "48x36", "--grid", "128", "--spp", "1", "-o", folder / "b.exr"}).code,
      0);
  const Outcome plain = render(6, folder / "b.exr", {"--resume", "on"});
  EXPECT_EQ(plain.code, 1);
  EXPECT_TRUE(plain.says(other)) << plain.err;
  write_file(folder / "c.exr", "no picture");
  EXPECT_EQ(render(6, folder / "c.exr", {"--resume", "on"}).code, 1);
}

TEST_F(SupersampledFrame, AUsageErrorSaysWhatGoesWithIt) {
  const auto expect_usage = [&](const Outcome& outcome, const std::string& sentence) {
    EXPECT_EQ(outcome.code, 2);
    EXPECT_TRUE(outcome.says(sentence)) << outcome.err;
  };
  expect_usage(render(4, folder / "a.exr", {"--repeat", "2"}), "--repeat and --peer do not go with it");
  expect_usage(render(4, folder / "a.exr", {"--peer", "on"}), "--repeat and --peer do not go with it");
  expect_usage(izb::test::izb({"render", scene, "--supersample", "4", "--resume", "on", "--preview", folder / "a.png"}),
               "--resume needs -o with --supersample");
  expect_usage(render(-1, folder / "a.exr"), "supersample");
  expect_usage(render(1 << 20, folder / "a.exr"), "supersample");
  EXPECT_FALSE(fs::exists(folder / "a.exr"));
  const Outcome help = izb::test::izb({"render", "--help"});
  EXPECT_TRUE(help.prints("--supersample") && help.prints("--checkpoint"));
}

TEST_F(SupersampledFrame, EachOfASequenceIsResumed) {
  const fs::path output = folder / "f.exr";
  const fs::path path = write_file(folder / "path.json",
                                   R"({"keys": [{"time": 0, "eye": [0, 8, 8], "target": [0, 0, 0]},
                                                {"time": 1, "eye": [8, 8, 0], "target": [0, 0, 0]}]})");
  ASSERT_EQ(render(2, output, {"--camera-path", path, "--frames", "0:1"}).code, 0);
  const Outcome more = render(3, output, {"--camera-path", path, "--frames", "0:2", "--resume", "on"});
  ASSERT_EQ(more.code, 0) << more.err;
  ASSERT_EQ(render(3, folder / "whole.exr", {"--camera-path", path, "--frames", "0:2"}).code, 0);
  for (const char* n : {"0000", "0001", "0002"}) {
    EXPECT_EQ(held(folder / (std::string("f.") + n + ".exr")), 3);
    expect_same(folder / (std::string("f.") + n + ".exr"), folder / (std::string("whole.") + n + ".exr"));
  }
  const Outcome again = render(3, output, {"--camera-path", path, "--frames", "0:2", "--resume", "on"});
  EXPECT_TRUE(again.says("all frames were there already")) << again.err;
}

}  // namespace
