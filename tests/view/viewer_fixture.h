// SPDX-License-Identifier: MIT
// A viewer on a small scene in a window of 480 x 300, which the cases of a file share as long as each leaves it as it
// was.
#pragma once
#include <gtest/gtest.h>

#include <memory>

#include "view/captures.h"
#include "view/contract.h"
#include "view/viewer.h"
#include "view/viewer_scenes.h"

namespace izb::test {

namespace fs = std::filesystem;

inline constexpr Point centre{240, 150};

struct ViewerTest : testing::Test {
  static inline std::unique_ptr<TemporaryFolder> folder;
  static inline std::unique_ptr<XDisplay> display;
  static inline std::unique_ptr<Viewer> viewer;  ///< its panels are hidden
  static inline json first_state;
  static inline fs::path scene;

  static void SetUpTestSuite() {
    folder = std::make_unique<TemporaryFolder>();
    display = std::make_unique<XDisplay>();
    scene = write_file(*folder / "posts.glb", posts_on_floor().glb());
  }
  static void TearDownTestSuite() {
    if (viewer && viewer->runs()) viewer->stop();
    viewer = nullptr;
    display = nullptr;
    folder = nullptr;
  }

  void SetUp() override {
    if (viewer && viewer->runs() && viewer->state() == first_state) {
      viewer->input().key("Escape");  // messages of the case before stay for seconds
      return;
    }
    if (viewer && viewer->runs()) viewer->stop();
    viewer = open();
    first_state = viewer->state();
  }

  static fs::path home() { return *folder / "home"; }
  static fs::path written() { return *folder / "written"; }  ///< where screenshots, paths and states go

  /// At rest, without hints and panels.
  static std::unique_ptr<Viewer> open(std::vector<std::string> more = {}, const Environment& environment = {}) {
    fs::create_directories(written());
    std::vector<std::string> words{IZB_PROGRAM, "view", scene, "--size", "480x300", "--folder", written()};
    words.insert(words.end(), more.begin(), more.end());
    auto opened = std::make_unique<Viewer>(*display, ViewerOptions{words, home(), environment});
    opened->wait_for("picture", at_rest);
    opened->wait_for("widgets");
    if (opened->has_widget(dismiss_hints)) opened->input().click(opened->widget(dismiss_hints));
    opened->input().key("Tab");
    display->move(centre);
    opened->still_capture();
    return opened;
  }

  static bool at_rest(const json& picture) { return picture["scale"] == 1.0 && !picture["motion"].get<bool>(); }

  /// Side 0 or 1 of a picture at rest has that many samples.
  static Viewer::Predicate rests_with_spp(int spp, size_t side = 0) {
    return [=](const json& p) {
      return at_rest(p) && p["sides"].size() > side && p["sides"][side]["spp"] == spp &&
             p["sides"][side]["error"] == "";
    };
  }
  static Viewer::Predicate shows_technique(const std::string& name) {
    return [=](const json& p) {
      for (const json& side : p["sides"])
        if (at_rest(p) && side["technique"] == name) return true;
      return false;
    };
  }

  /// Presses C until pictures are compared in that way.
  static void compare(const std::string& how) {
    for (int i = 0; compare_of(viewer->state()) != how; ++i) {
      ASSERT_LT(i, 4) << "C never comes to " << how;
      const std::string before = compare_of(viewer->state());
      viewer->input().key("c");
      viewer->wait_for("state", [&](const json& s) { return compare_of(s["state"]) != before; });
    }
  }
  /// Two sides that differ by their samples only, as at the start: 32 at the left, one at the right.
  static void split_32_and_1() {
    compare("split");
    viewer->wait_for("picture", [](const json& p) { return rests_with_spp(32)(p) && rests_with_spp(1, 1)(p); });
  }
};

/// Numbers within `tolerance` of each other, all else equal.
inline bool alike(const json& a, const json& b, double tolerance) {
  if (a.is_number() && b.is_number()) return std::abs(a.get<double>() - b.get<double>()) <= tolerance;
  if (a.type() != b.type() || a.size() != b.size()) return false;
  if (!a.is_structured()) return a == b;
  for (const auto& [key, value] : a.items())
    if (a.is_object() ? !b.contains(key) || !alike(value, b[key], tolerance)
                      : !alike(value, b[size_t(std::stoul(key))], tolerance))
      return false;
  return true;
}

}  // namespace izb::test
