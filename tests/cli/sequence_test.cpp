// SPDX-License-Identifier: MIT
// Animated sequences: numbered files, moments, resuming, and that no frame depends on those before it.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/run_program.h"
#include "cli/small_scenes.h"
#include "image/exr.h"

namespace {

namespace fs = std::filesystem;
using namespace izb::test;
using izb::Image;

/// The roof goes to the left and right within two seconds; a node with a morph target grows and shrinks.
GltfWriter moving_roof() {
  GltfWriter gltf = roof_over_floor();
  json& roof = gltf.root["meshes"][1]["primitives"][0];
  roof["targets"] = {{{"POSITION", gltf.add_positions({-1, 0, -1, -1, 0, 1, 1, 0, 1, 1, 0, -1})}}};
  const int times = gltf.add_array(std::vector<float>{0, 1, 2}, type_float, "SCALAR", 1);
  const int places = gltf.add_array(std::vector<float>{-2, 0, 0, 2, 0, 0, -2, 0, 0}, type_float, "VEC3", 3);
  const int weights = gltf.add_array(std::vector<float>{0, 1, 0}, type_float, "SCALAR", 1);
  json channel = {{"sampler", 0}, {"target", {{"node", 1}, {"path", "translation"}}}};
  json growing = {{"sampler", 1}, {"target", {{"node", 1}, {"path", "weights"}}}};
  gltf.append("animations",
              {{"name", "slide"},
               {"samplers", {{{"input", times}, {"output", places}}, {{"input", times}, {"output", weights}}}},
               {"channels", {channel, growing}}});
  return gltf;
}

struct Sequence : testing::Test {
  const TemporaryFolder folder;
  const fs::path scene = write_file(folder / "roof.glb", moving_roof().glb());

  Outcome render(const std::string& frames, const std::vector<std::string>& more,
                 const std::string& output = "frame.exr") const {
    std::vector<std::string> words{"render", scene, "--size", "96x72", "--grid", "128", "--frames", frames, "-o"};
    words.push_back(folder / output);
    words.insert(words.end(), more.begin(), more.end());
    return izb::test::izb(words);
  }
  fs::path frame(int n, const char* extension = ".exr") const {
    return folder / (std::string("frame.000") + std::to_string(n) + extension);
  }
};

TEST_F(Sequence, EachFrameIsThatRenderedAlone) {
  const Outcome outcome = render("0:6", {"--fps", "4", "--json", folder / "frame.json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  std::set<std::string> hashes;
  for (int n = 0; n <= 6; ++n) {
    const json its = read_json(frame(n, ".json"));
    EXPECT_EQ(its["frame"], n);
    EXPECT_EQ(its["time_s"], n / 4.0);
    hashes.insert(its["mask_hash"].get<std::string>());
  }
  EXPECT_FALSE(fs::exists(frame(7)));
  EXPECT_EQ(hashes.size(), 5u);  // frames 4 +- n show the same
  const Image last = izb::read_exr(frame(6));
  ASSERT_EQ(render("6", {"--fps", "4"}, "alone##.exr").code, 0);
  const Image alone = izb::read_exr(folder / "alone06.exr");
  ASSERT_EQ(
      izb::test::izb({"render", scene, "--size", "96x72", "--grid", "128", "--time", "1.5", "-o", folder / "still.exr"})
          .code,
      0);
  const Image still = izb::read_exr(folder / "still.exr");
  for (const Image* image : {&alone, &still}) {
    EXPECT_EQ(image->uints("mask"), last.uints("mask"));
    for (const char* channel : {"R", "G", "B", "depth", "normal.X", "visibility", "list_length"})
      EXPECT_EQ(image->floats(channel), last.floats(channel)) << channel;
  }
}

TEST_F(Sequence, ResumesWhereItStopped) {
  ASSERT_EQ(render("0:3", {"--fps", "5"}).code, 0);
  const auto first_written = fs::last_write_time(frame(1));
  fs::remove(frame(2));
  const Outcome outcome = render("0:4", {"--fps", "5", "--resume", "on"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  for (const char* rendered : {"frame 2", "frame 4"}) EXPECT_TRUE(outcome.prints(rendered)) << outcome.out;
  for (const char* kept : {"frame 0", "frame 1", "frame 3"}) EXPECT_FALSE(outcome.prints(kept)) << outcome.out;
  EXPECT_EQ(fs::last_write_time(frame(1)), first_written);
  EXPECT_TRUE(render("0:4", {"--fps", "5", "--resume", "on"}).says("all frames were there already"));
  // Frames of another kind are not taken for these.
  const Outcome other = render("0:4", {"--fps", "5", "--resume", "on", "--spp", "1"});
  EXPECT_EQ(other.code, 1);
  EXPECT_TRUE(other.says("was rendered with other options")) << other.err;
  write_file(frame(3), "no picture");
  const Outcome broken = render("0:4", {"--fps", "5", "--resume", "on"});
  EXPECT_EQ(broken.code, 1);
  EXPECT_TRUE(broken.says("frame.0003.exr")) << broken.err;
}

TEST_F(Sequence, FollowsACameraPath) {
  const auto path = write_file(folder / "path.json",
                               R"({"keys": [{"time": 0, "eye": [0, 8, 8], "target": [0, 0, 0]},
                                            {"time": 1, "eye": [8, 8, 0], "target": [0, 0, 0]}]})");
  ASSERT_EQ(render("0:1", {"--fps", "1", "--camera-path", path}).code, 0);
  EXPECT_NE(izb::read_exr(frame(0)).floats("depth"), izb::read_exr(frame(1)).floats("depth"));
  // A scene that does not move may be flown through.
  const auto still = write_file(folder / "still.glb", roof_over_floor().glb());
  const Outcome flown = izb::test::izb({"render", still, "--size", "48x36", "--frames", "0:1", "--fps", "1",
                                        "--camera-path", path, "-o", folder / "flown.exr"});
  EXPECT_EQ(flown.code, 0) << flown.err;
  EXPECT_TRUE(fs::exists(folder / "flown.0001.exr"));
}

TEST_F(Sequence, WhatCannotBeIsASentence) {
  for (const char* frames : {"3:1", "-1:4", "a", "1:2:3", "1-4"}) {
    const Outcome outcome = render(frames, {});
    EXPECT_EQ(outcome.code, 2) << frames;
    EXPECT_TRUE(outcome.says("--frames must be FIRST:LAST")) << outcome.err;
  }
  const Outcome both = render("0:1", {"--camera-path", "x.json", "--camera", "0"});
  EXPECT_EQ(both.code, 2);
  EXPECT_TRUE(both.says("exclude each other")) << both.err;
  const Outcome unknown = render("0:1", {"--animation", "jump"});
  EXPECT_EQ(unknown.code, 1);
  EXPECT_TRUE(unknown.says("it has no animation 'jump'; there are 0 'slide'")) << unknown.err;
  const Outcome folderless = render("0:1", {}, "none/frame.exr");
  EXPECT_EQ(folderless.code, 1);
  const Outcome resume = izb::test::izb({"render", scene, "-o", folder / "x.exr", "--resume", "on"});
  EXPECT_EQ(resume.code, 2);
  EXPECT_TRUE(resume.says("--resume goes with --frames")) << resume.err;
}

}  // namespace
