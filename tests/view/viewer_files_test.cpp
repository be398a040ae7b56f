// SPDX-License-Identifier: MIT
// What the viewer reads and writes: dropped scenes, shaders, screenshots, commands, paths, states, settings.
#include <set>

#include "cli/run_program.h"
#include "image/exr.h"
#include "image/png.h"
#include "view/viewer_fixture.h"
#include "view/xdnd_source.h"

namespace {

using namespace izb::test;
using izb::Image8;

struct Files : ViewerTest {
  /// Of those that `wrote` names, the first with that extension, which must exist.
  static fs::path of_type(const json& wrote, const std::string& extension) {
    for (const json& file : wrote["files"]) {
      const fs::path path = written() / file.get<std::string>();  // an absolute one replaces the folder
      if (path.extension() != extension) continue;
      EXPECT_TRUE(fs::exists(path)) << path;
      return path;
    }
    ADD_FAILURE() << "no " << extension << " in " << wrote;
    return {};
  }

  static json copied_command() {
    viewer->input().key("ctrl+c");
    return viewer->wait_for("command")["text"];
  }

  /// Runs a command as it was copied, and returns the frame that it writes to `name`.exr.
  static fs::path run_copied(const std::string& command, const std::string& name) {
    const fs::path programs = *folder / "bin", exr = *folder / (name + ".exr");
    fs::create_directories(programs);
    if (!fs::exists(programs / "izb")) fs::create_symlink(IZB_PROGRAM, programs / "izb");
    const bool writes = command.find(" -o ") != std::string::npos;
    const std::string line = writes ? command : command + " -o '" + exr.string() + "'";
    const Outcome outcome = run_program(
        {"sh", "-c", "cd '" + written().string() + "' && PATH='" + programs.string() + "':$PATH && " + line},
        {{{"LIBGL_ALWAYS_SOFTWARE", "1"}}, false});
    EXPECT_EQ(outcome.code, 0) << line << "\n" << outcome.err;
    if (!writes) return exr;
    const size_t start = command.find(" -o ") + 4;
    return written() / command.substr(start, command.find(' ', start) - start);
  }
};

TEST_F(Files, ADroppedSceneIsShown) {
  const fs::path grass = *folder / "gr\u00e4s 5000.glb";
  ASSERT_EQ(izb::test::izb({"scene", "grass", "--triangles", "5000", "-o", grass}).code, 0);
  ASSERT_TRUE(drop_files(viewer->input(), {grass}, centre));
  const json its_scene = viewer->wait_for("scene");
  EXPECT_EQ(its_scene["file"].get<std::string>(), grass.string());
  EXPECT_NEAR(its_scene["triangles"].get<double>(), 5000, 500);
  viewer->wait_at_rest();
  const Image8 shown = viewer->still_capture();
  EXPECT_FALSE(is_flat(shown, middle_of(shown)));
  ASSERT_TRUE(drop_files(viewer->input(), {scene}, centre));
  EXPECT_EQ(viewer->wait_for("scene")["triangles"], 2 * (2 + 81));
}

TEST_F(Files, ABrokenDropIsASentenceAndTheOldSceneStays) {
  const Image8 before = viewer->still_capture();
  std::string cut = posts_on_floor().glb();
  cut.resize(cut.size() / 2);
  for (const fs::path& bad :
       {write_file(*folder / "text.glb", "no scene"), write_file(*folder / "cut.glb", cut), *folder / "missing.gltf"}) {
    drop_files(viewer->input(), {bad}, centre);
    const json message = viewer->wait_for("message", [](const json& m) { return m["kind"] == "error"; });
    EXPECT_NE(message["text"].get<std::string>().find(bad.filename().string()), std::string::npos) << message;
    EXPECT_TRUE(viewer->since_input("scene").empty());
  }
  viewer->input().key("1");
  viewer->wait_for("picture", rests_with_spp(1));
  viewer->input().key("1");
  viewer->wait_for("picture", rests_with_spp(32));
  viewer->input().key("Escape");  // the message
  EXPECT_TRUE(wait_until(30.0, [&] { return changed(before, display->capture(), middle_of(before)) == 0; }));
}

TEST_F(Files, TheCopiedCommandRendersTheSameMask) {
  viewer->input().drag({200, 150}, {270, 170}, Button::left, 20);
  viewer->wait_at_rest();
  XDisplay& x = viewer->input();
  x.key_down("l");
  x.drag({200, 150}, {230, 160}, Button::left, 10);
  x.key_up("l");
  for (const int spp : {32, 1}) {
    if (spp == 1) viewer->input().key("1");
    const json picture = viewer->wait_at_rest();
    ASSERT_EQ(picture["sides"][0]["spp"], spp);
    viewer->input().key("F2");
    const json wrote = viewer->wait_for("wrote");
    const Image8 png = izb::read_png(of_type(wrote, ".png"));
    EXPECT_EQ(png.width_px, 480);
    EXPECT_EQ(png.height_px, 300);
    EXPECT_FALSE(is_flat(png, middle_of(png)));
    EXPECT_EQ(read_json(of_type(wrote, ".json"))["mask_hash"], picture["sides"][0]["mask_hash"]);
    const izb::Image frame = izb::read_exr(of_type(wrote, ".exr"));
    const std::string command = copied_command();
    EXPECT_TRUE(command.starts_with("izb render ")) << command;
    EXPECT_EQ(display->clipboard(), command);
    const izb::Image batch = izb::read_exr(run_copied(command, "batch" + std::to_string(spp)));
    EXPECT_EQ(batch.uints("mask"), frame.uints("mask"));
    EXPECT_EQ(batch.floats("depth"), frame.floats("depth"));
    const izb::Attribute& hash = batch.attributes.at("izb.mask_hash");
    EXPECT_EQ(std::get<std::string>(hash), picture["sides"][0]["mask_hash"].get<std::string>());
  }
}

TEST_F(Files, APathIsRecordedAndReplayed) {
  const json first = viewer->last("picture")["eye"];
  viewer->input().key("F3");
  display->drag({200, 150}, {300, 180}, Button::left, 40);
  const json last = viewer->wait_at_rest()["eye"];
  constexpr double near = 0.05;  // the scene's side is 10
  ASSERT_FALSE(alike(first, last, 10 * near));
  viewer->input().key("F3");
  of_type(viewer->wait_for("wrote"), ".json");
  viewer->input().key("Home");
  ASSERT_TRUE(alike(viewer->wait_at_rest()["eye"], first, near));
  viewer->input().key("F4");
  viewer->wait_for("picture",
                   [&](const json& p) { return !alike(p["eye"], first, near) && !alike(p["eye"], last, near); });
  viewer->wait_for("picture", [&](const json& p) { return at_rest(p) && alike(p["eye"], last, near); });
}

TEST_F(Files, APathThatIsLeftLeavesNoMomentBehind) {
  viewer->input().key("F3");
  display->drag({200, 150}, {300, 180}, Button::left, 40);
  viewer->wait_at_rest();
  viewer->input().key("F3");
  viewer->wait_for("wrote");
  viewer->input().key("F4");
  viewer->wait_for("picture", [](const json& p) { return p["motion"].get<bool>(); });
  viewer->input().drag({200, 150}, {205, 150}, Button::left, 5);
  const json left = viewer->wait_at_rest();
  EXPECT_EQ(left["sides"][0]["error"], "");
  EXPECT_EQ(time_of(viewer->state()), -1.0) << "the scene has no animation";
  EXPECT_EQ(copied_command().get<std::string>().find("--time"), std::string::npos);
}

TEST_F(Files, WhatIsLoadedAgainIsShownAgain) {
  viewer->input().key("ctrl+s");
  viewer->wait_for("wrote");
  viewer->input().key("ctrl+o");
  viewer->wait_for("scene");
  viewer->wait_for("picture", at_rest);
}

TEST_F(Files, ACameraByNumbersIsWhereTheMouseFindsIt) {
  viewer->stop();
  viewer = open({"--eye", "3,4,5", "--target", "0,0.5,0"});
  EXPECT_EQ(viewer->last("picture")["eye"], json({3.0, 4.0, 5.0}));
  viewer->input().drag({200, 150}, {203, 150}, Button::left, 3);
  const json eye = viewer->wait_at_rest()["eye"];
  EXPECT_NE(eye, json({3.0, 4.0, 5.0}));
  EXPECT_TRUE(alike(eye, json({3.0, 4.0, 5.0}), 0.3)) << eye;
}

TEST_F(Files, ANameThatIsNoUtf8IsShownButNotKept) {
  viewer->stop();
  const fs::path odd = *folder / "caf\xe9.glb";
  fs::copy_file(scene, odd, fs::copy_options::overwrite_existing);
  fs::create_directories(written());
  Viewer shown(*display, {{IZB_PROGRAM, "view", odd, "--size", "300x200", "--folder", written()}, home(), {}});
  EXPECT_EQ(shown.wait_for("picture", at_rest)["sides"][0]["error"], "");
  shown.input().key("ctrl+s");
  EXPECT_EQ(shown.wait_for("message")["kind"], "error");
  shown.stop();
  viewer = nullptr;
}

TEST_F(Files, AScreenshotDoesNotKeepTheTruthAway) {
  viewer->input().key("r");
  display->key("F2");
  viewer->wait_for("wrote");
  viewer->wait_for("picture", [](const json& p) {
    return at_rest(p) && p["sides"].size() == 2 && p["sides"][1]["technique"] == "truth";
  });
}

TEST_F(Files, TheStateOutlivesTheProgram) {
  viewer->input().drag({200, 150}, {280, 170}, Button::left, 20);
  display->key("1");
  compare("split");
  viewer->wait_at_rest();
  const json before = viewer->state();
  viewer->input().key("ctrl+s");
  const fs::path file = of_type(viewer->wait_for("wrote"), ".json");
  // Loaded again where it was saved.
  viewer->input().drag({200, 150}, {240, 190}, Button::left, 20);
  viewer->wait_for("state", [&](const json& s) { return s["state"] != before; });
  viewer->wait_at_rest();
  viewer->input().key("ctrl+o");
  viewer->wait_for("state", [&](const json& s) { return s["state"] == before; });
  // Whatever comes of files that were dropped the moment before and are still being loaded.
  const fs::path large = *folder / "hairball.glb";
  ASSERT_EQ(run_program({IZB_PROGRAM, "scene", "hairball", "--triangles", "300000", "-o", large}).code, 0);
  viewer->input().key("1");
  viewer->wait_for("state", [&](const json& s) { return s["state"] != before; });
  drop_files(viewer->input(), {large}, {0, 0});
  drop_files(viewer->input(), {*folder / "missing.glb"}, {0, 0});
  viewer->input().key("ctrl+o");
  viewer->wait_for("scene", [&](const json& its) { return its["file"] == before["scene"]; });
  viewer->wait_at_rest();
  EXPECT_EQ(viewer->state(), before);
  // And by another process.
  viewer->stop();
  Viewer again(*display, {{IZB_PROGRAM, "view", "--state", file, "--size", "480x300"}, home(), {}});
  again.wait_for("picture", at_rest);
  EXPECT_EQ(again.state(), before);
  again.stop();
  const Outcome outcome = run_program({IZB_PROGRAM, "view", "--state", write_file(*folder / "bad.json", "{")},
                                      {{{"DISPLAY", display->name()}}, false});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_TRUE(outcome.says("bad.json")) << outcome.err;
}

struct Shaders : Files {
  const fs::path glsl = *folder / "glsl";
  const fs::path shade = glsl / "frame" / "6_shade.comp.glsl";
  void SetUp() override { fs::copy(IZB_SOURCE_DIR "/glsl", glsl, fs::copy_options::recursive); }
  void TearDown() override { fs::remove_all(glsl); }

  static std::string text_of(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  static Viewer::Predicate flag(const std::string& colour) {
    return [=](const json& s) { return s["flag"] == colour; };
  }
};

TEST_F(Shaders, AreReadAgainWhenTheyChange) {
  if (viewer && viewer->runs()) viewer->stop();
  viewer = open({}, {{"IZB_GLSL", glsl}});
  const Image8 before = viewer->still_capture();
  const std::string good = text_of(shade);
  viewer->input();
  write_file(shade, good + "\nthis is no shader\n");
  const json red = viewer->wait_for("shaders", flag("red"));
  const auto lines = std::to_string(std::count(good.begin(), good.end(), '\n') + 2);
  EXPECT_NE(red["text"].get<std::string>().find("6_shade.comp.glsl:" + lines), std::string::npos) << red;
  // The picture goes on with the old ones.
  viewer->input().drag({200, 150}, {260, 150}, Button::left, 20);
  viewer->wait_at_rest();
  EXPECT_GT(changed(before, viewer->still_capture(), middle_of(before)), 1000u);
  viewer->input();
  write_file(shade, good);
  viewer->wait_for("shaders", flag("green"));
  viewer->input().key("F5");
  viewer->wait_for("shaders", flag("green"));
  viewer->input().key("Home");
  viewer->wait_at_rest();
  EXPECT_EQ(changed(before, viewer->still_capture(), middle_of(before)), 0u);
}

/// A person whose home is empty.
struct Settings : ViewerTest {
  const fs::path own = *folder / "own";
  const fs::path settings = own / ".config" / "izb" / "view.json";
  void SetUp() override {}

  std::unique_ptr<Viewer> start() const {
    auto started = std::make_unique<Viewer>(
        *display, ViewerOptions{{IZB_PROGRAM, "view", scene, "--size", "480x300", "--folder", own / "out"}, own, {}});
    started->wait_for("picture", at_rest);
    started->wait_for("widgets");
    return started;
  }
  std::set<fs::path> files() const {
    std::set<fs::path> found;
    for (const auto& entry : fs::recursive_directory_iterator(own))
      if (!entry.is_directory() && entry.path().extension() != ".jsonl") found.insert(entry.path());
    return found;
  }
};

TEST_F(Settings, HintsComeUntilTheyAreDismissed) {
  fs::create_directories(own / "out");
  for (int i = 0; i < 2; ++i) {
    const auto window = start();
    EXPECT_TRUE(window->has_widget(dismiss_hints)) << "start " << i;
    window->input().drag({200, 200}, {220, 210});
    window->wait_at_rest();
    if (i == 1) {
      window->input().click(window->widget(dismiss_hints));
      window->wait_for("widgets", [](const json& w) { return !w["rects"].contains(dismiss_hints); });
    }
    window->stop();
  }
  const auto window = start();
  EXPECT_FALSE(window->has_widget(dismiss_hints));
  window->stop();
  // Nothing else is left behind.
  EXPECT_EQ(files(), std::set<fs::path>{settings});
}

TEST_F(Settings, AnotherFileMayBeNamed) {
  const fs::path named = *folder / "named.json";
  Viewer window(*display,
                {{IZB_PROGRAM, "view", scene, "--size", "480x300", "--settings", named}, *folder / "third", {}});
  window.wait_for("widgets", [](const json& w) { return w["rects"].contains(dismiss_hints); });
  window.input().click(window.widget(dismiss_hints));
  window.wait_for("widgets", [](const json& w) { return !w["rects"].contains(dismiss_hints); });
  window.stop();
  EXPECT_TRUE(fs::exists(named));
  EXPECT_FALSE(fs::exists(*folder / "third" / ".config" / "izb" / "view.json"));
}

}  // namespace
