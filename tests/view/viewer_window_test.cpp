// SPDX-License-Identifier: MIT
// The viewer's window: sizes, focus, minimising, animation, and where there is none.
#include "cli/run_program.h"
#include "view/viewer_fixture.h"

namespace {

using namespace izb::test;
using izb::Image8;

struct Window : ViewerTest {};

TEST_F(Window, TakesAnySize) {
  const Image8 before = viewer->still_capture();
  const Point sizes[] = {{700, 200}, {1, 1}, {97, 61}, {1, 400}, {480, 300}};
  for (const Point& size : sizes) {
    viewer->input().resize_window(size.x, size.y);
    viewer->wait_at_rest();
    EXPECT_EQ(display->size(), size);
    EXPECT_EQ(viewer->last("picture")["sides"][0]["error"], "") << size.x << "x" << size.y;
  }
  EXPECT_TRUE(wait_until(15.0, [&] { return changed(before, display->capture(), middle_of(before)) == 0; }));
}

TEST_F(Window, ComesBackAsItWas) {
  const Image8 before = viewer->still_capture();
  viewer->input().unmap();
  sleep_s(1.0);
  display->map();
  EXPECT_TRUE(wait_until(15.0, [&] { return changed(before, display->capture(), middle_of(before)) == 0; }));
  viewer->input().drag({200, 150}, {260, 150}, Button::left, 10);
  viewer->wait_at_rest();
  EXPECT_GT(changed(before, viewer->still_capture(), middle_of(before)), 1000u);
}

TEST_F(Window, NothingFliesOnWithoutTheFocus) {
  const json first = camera_of(viewer->state());
  display->move(centre);
  viewer->input().button_down(Button::right);
  display->key_down("s");
  viewer->wait_for("state", [&](const json& s) { return camera_of(s["state"]) != first; });
  viewer->input().take_focus();
  sleep_s(0.5);
  viewer->wait_at_rest();
  const json stopped = camera_of(viewer->state());
  sleep_s(1.5);
  EXPECT_EQ(camera_of(viewer->state()), stopped);
  display->key_up("s");
  display->button_up(Button::right);
  viewer->input().focus();
  sleep_s(0.5);
  EXPECT_EQ(camera_of(viewer->state()), stopped);
  viewer->input().key("Home");
  viewer->wait_at_rest();
  EXPECT_EQ(camera_of(viewer->state()), first);
}

struct Animated : ViewerTest {
  const fs::path file = write_file(*folder / "sliding.glb", sliding_roof().glb());
  void SetUp() override {
    if (viewer && viewer->runs()) viewer->stop();
    viewer = std::make_unique<Viewer>(
        *display, ViewerOptions{{IZB_PROGRAM, "view", file, "--size", "480x300", "--time", "0.3"}, home(), {}});
    viewer->wait_for("picture", at_rest);
  }
};

TEST_F(Animated, PlaysPausesAndSteps) {
  EXPECT_NEAR(time_of(viewer->state()), 0.3, 1e-9);
  viewer->input().key("space");
  viewer->wait_for("state", [](const json& s) { return time_of(s["state"]) > 0.5; });
  viewer->input().key("space");
  viewer->wait_at_rest();
  const double paused = time_of(viewer->state());
  sleep_s(0.5);
  EXPECT_EQ(time_of(viewer->state()), paused);
  const std::string hash = viewer->last("picture")["sides"][0]["mask_hash"];
  viewer->input().key("period");
  EXPECT_NE(viewer->wait_at_rest()["sides"][0]["mask_hash"], hash);
  EXPECT_GT(time_of(viewer->state()), paused);
  viewer->input().key("comma");
  EXPECT_EQ(viewer->wait_at_rest()["sides"][0]["mask_hash"], hash);
  EXPECT_NEAR(time_of(viewer->state()), paused, 1e-9);
}

TEST(WindowLess, WhereThereIsNoDisplayItSaysWhatThereIs) {
  const std::vector<std::vector<std::string>> ways = {{"env", "-u", "DISPLAY", "-u", "WAYLAND_DISPLAY"},
                                                      {"env", "-u", "WAYLAND_DISPLAY", "DISPLAY=:4711"}};
  for (std::vector<std::string> words : ways) {
    words.insert(words.end(), {IZB_PROGRAM, "view"});
    const Outcome outcome = run_program(words);
    EXPECT_EQ(outcome.code, 1) << testing::PrintToString(words);
    EXPECT_TRUE(outcome.says("izb render")) << outcome.err;
    EXPECT_EQ(outcome.error_lines().size(), 1u) << outcome.err;
  }
}

TEST(WindowLess, BadArgumentsAreASentence) {
  for (const char* option : {"--state", "--folder"}) {
    const Outcome outcome = run_program({IZB_PROGRAM, "view", option, "/nonexistent/x"});
    EXPECT_EQ(outcome.code, 1) << option;
    EXPECT_TRUE(outcome.says("/nonexistent/x")) << outcome.err;
  }
  EXPECT_EQ(run_program({IZB_PROGRAM, "view", "--nonsense"}).code, 2);
  EXPECT_EQ(run_program({IZB_PROGRAM, "view", "--fov", "60"}).code, 2) << "without --eye, as izb render";
}

}  // namespace
