// SPDX-License-Identifier: MIT
// The viewer's state as a file and as a command line; what it keeps.
#include <gtest/gtest.h>

#include <fstream>

#include "base/error.h"
#include "base/file.h"
#include "view/difference.h"
#include "view/path_recorder.h"
#include "view/settings.h"
#include "view/shader_watch.h"
#include "view/state.h"

namespace izb::test {
namespace {

namespace fs = std::filesystem;

struct Folder {
  const fs::path path = fs::path(testing::TempDir()) / fmt::format("izb_view_{}", getpid());
  Folder() { fs::create_directories(path); }
  ~Folder() { fs::remove_all(path); }
};

ViewState some_state() {
  ViewState state;
  state.scene = "/a folder/scene.glb";
  state.frame.eye = "1,2,3";
  state.frame.target = "0,0.1,-7";
  state.frame.fov_deg = 31.25;
  state.frame.light = "low sun;2";
  state.frame.time_s = 0.1;
  state.sides[0] = SideState::of("izb", "exact");
  state.sides[0].options["grid"] = 512;
  state.sides[0].options["zcull"] = false;
  state.sides[1] = SideState::of("ray_traced");
  state.active = 1;
  state.truth = true;
  state.compare = Compare::difference;
  state.split = 0.25;
  state.look = "depth";
  state.frusta = true;
  state.lens = true;
  state.lens_power = 16;
  state.picked = {3, 4};
  return state;
}

TEST(ViewState, AFileKeepsAllOfIt) {
  const ViewState state = some_state();
  const ViewState read = ViewState::from_json(nlohmann::json::parse(state.to_json().dump()));
  EXPECT_EQ(read.to_json(), state.to_json());
  EXPECT_EQ(read.sides[0].make()->options().to_json(), state.sides[0].options);
  EXPECT_NE(ViewState().to_json(), state.to_json());
}

TEST(ViewState, WhatIsWrongInAFileIsSaid) {
  const auto refusal = [](const char* text) -> std::string {
    try {
      ViewState::from_json(nlohmann::json::parse(text));
    } catch (const Error& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_NE(refusal("[]"), "");
  EXPECT_NE(refusal(R"({"sides": [{}]})").find("two"), std::string::npos);
  EXPECT_NE(refusal(R"({"sides": [{"technique": "magic"}, {}]})").find("magic"), std::string::npos);
  EXPECT_NE(refusal(R"({"sides": [{"options": {"grid": 3}}, {}]})").find("grid"), std::string::npos);
  EXPECT_NE(refusal(R"({"sides": [{"options": {"gird": 300}}, {}]})").find("gird"), std::string::npos);
  EXPECT_NE(refusal(R"({"frame": {"fov": "wide"}})").find("fov"), std::string::npos);
  EXPECT_NE(refusal(R"({"compare": "maybe"})").find("maybe"), std::string::npos);
  EXPECT_NE(refusal(R"({"split": "left"})"), "");
  EXPECT_NE(refusal(R"({"picked": [1]})"), "");
  EXPECT_EQ(ViewState::from_json(nlohmann::json::parse(R"({"lens_power": 1000, "active": 7})")).lens_power, 32);
}

TEST(ViewState, TheCommandNamesWhatDiffersFromTheDefaults) {
  ViewState state = some_state();
  EXPECT_EQ(batch_command(state, 0, {640, 360}),
            "izb render '/a folder/scene.glb' --size 640x360 --eye 1,2,3 --target 0,0.1,-7 --fov 31.25 "
            "--light 'low sun;2' --time 0.1 --coverage exact --insertion exact --grid 512 --zcull off --pairs 4194304");
  EXPECT_EQ(batch_command(state, 1, {1, 2}),
            "izb render '/a folder/scene.glb' --size 1x2 --eye 1,2,3 --target 0,0.1,-7 --fov 31.25 "
            "--light 'low sun;2' --time 0.1 --technique ray_traced");
  ViewState plain;
  plain.scene = "it's.glb";
  EXPECT_EQ(batch_command(plain, 0, {8, 8}), "izb render 'it'\\''s.glb' --size 8x8");
}

TEST(ViewState, TheCommandLeavesOutWhatTheBatchProgramWouldRefuse) {
  ViewState state;
  state.scene = "x.glb";
  state.frame.camera = "main";
  state.frame.fov_deg = 60.0;  // goes with --eye alone
  EXPECT_EQ(batch_command(state, 0, {8, 8}), "izb render x.glb --size 8x8 --camera main");
}

TEST(Difference, OrangeWhereOnlyTheFirstIsLitBlueWhereOnlyTheSecond) {
  Image8 picture;
  picture.width_px = 4, picture.height_px = 1, picture.components = 4;
  picture.pixels.assign(16, 255);
  const std::vector<uint32_t> a{0, 0, 0xFFFFFFFF, 7}, b{0, 0xFFFFFFFF, 0, 15};
  const Image8 shown = difference_picture(picture, a, b);
  const auto at = [&](size_t i) {
    return std::array<int, 3>{shown.pixels[4 * i], shown.pixels[4 * i + 1], shown.pixels[4 * i + 2]};
  };
  const int grey = 255 * 254 / 1024;
  EXPECT_EQ(at(0), (std::array{grey, grey, grey}));
  EXPECT_EQ(at(1), (std::array{255, 127, grey}));
  EXPECT_EQ(at(2), (std::array{grey, 127, 255}));
  EXPECT_EQ(at(3)[0], 85) << "one sample is seen";
  EXPECT_EQ(at(3)[2], grey);
  EXPECT_THROW(difference_picture(picture, a, std::vector<uint32_t>{0}), std::logic_error);
}

TEST(ViewState, ARecordedPathReadsBackAsItWasFlown) {
  const Folder folder;
  PathRecorder recorder;
  CameraPose pose{{1.0 / 3.0, 2.0, 3.0}, {0.0, 1e-7, -2.0}, 50.0};
  recorder.add(10.0, pose);
  recorder.add(10.1, pose);  // too soon for a key
  pose.eye_ws.x = 5.0;
  recorder.add(10.5, pose);
  pose.eye_ws.x = 6.0;
  recorder.end(10.6, pose);
  ASSERT_EQ(recorder.path().keys.size(), 3u);
  write_file_atomically(folder.path / "path.json", camera_path_json(recorder.path()));
  const CameraPath read = read_camera_path(folder.path / "path.json");
  ASSERT_EQ(read.keys.size(), 3u);
  for (size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(read.keys[i].time_s, recorder.path().keys[i].time_s);
    EXPECT_EQ(read.keys[i].eye_ws, recorder.path().keys[i].eye_ws);
    EXPECT_EQ(read.keys[i].target_ws, recorder.path().keys[i].target_ws);
    EXPECT_EQ(read.keys[i].yfov_deg, 50.0);
  }
  EXPECT_EQ(read.keys[2].eye_ws.x, 6.0);
}

TEST(ViewSettings, AreRememberedAndBrokenOnesNamed) {
  const Folder folder;
  const fs::path file = folder.path / "deep" / "izb" / "view.json";
  EXPECT_TRUE(read_settings(file).hints);
  write_settings(file, {.hints = false});
  EXPECT_FALSE(read_settings(file).hints);
  write_file_atomically(file, "{");
  EXPECT_THROW(read_settings(file), Error);
  EXPECT_THROW(write_settings({}, {}), Error);
}

TEST(ViewSettings, NumberedFilesDoNotTakeAPlaceThatIsTaken) {
  const Folder folder;
  EXPECT_EQ(next_file(folder.path, "izb", ".png"), folder.path / "izb-0001.png");
  write_file_atomically(folder.path / "izb-0001.exr", "there");
  EXPECT_EQ(next_file(folder.path, "izb", ".png"), folder.path / "izb-0002.png");
}

TEST(ShaderWatch, NoticesWhatIsSaved) {
  const Folder folder;
  write_file_atomically(folder.path / "a.glsl", "1");
  ShaderWatch watch(folder.path);
  EXPECT_FALSE(watch.changed());
  write_file_atomically(folder.path / "b.h", "1");
  EXPECT_TRUE(watch.changed());
  EXPECT_FALSE(watch.changed());
  write_file_atomically(folder.path / "a.glsl~", "an editor's copy");
  EXPECT_FALSE(watch.changed());
  fs::last_write_time(folder.path / "a.glsl", fs::file_time_type::clock::now() + std::chrono::seconds(5));
  EXPECT_TRUE(watch.changed());
  fs::remove(folder.path / "b.h");
  EXPECT_TRUE(watch.changed());
}

}  // namespace
}  // namespace izb::test
