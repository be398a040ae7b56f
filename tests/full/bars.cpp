// SPDX-License-Identifier: MIT
// The bars at their stated sizes on real scenes: every .glb and .gltf file of the folder that $IZB_SCENES
// names, from the viewpoint of its name in bench/views.json. Prints its numbers; the small tests check the
// same in minutes.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/run_program.h"
#include "cpu/gltf_writer.h"

namespace {

namespace fs = std::filesystem;
using izb::test::Outcome;
using izb::test::run_program;
using izb::test::RunOptions;

constexpr const char* full_hd = "1920x1080";
const fs::path views = IZB_SOURCE_DIR "/bench/views.json";

nlohmann::json read_json(const fs::path& path) {
  return nlohmann::json::parse(std::ifstream(path));
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const size_t n = values.size();
  return n == 0 ? 0.0 : 0.5 * (values[(n - 1) / 2] + values[n / 2]);
}

struct Bars : testing::Test {
  const izb::test::TemporaryFolder folder;
  std::vector<fs::path> scenes;

  void SetUp() override {
    const char* named = std::getenv("IZB_SCENES");
    if (!named) GTEST_SKIP() << "IZB_SCENES is not set";
    for (const auto& entry : fs::directory_iterator(named))
      if (entry.path().extension() == ".glb" || entry.path().extension() == ".gltf") scenes.push_back(entry.path());
    std::sort(scenes.begin(), scenes.end());
    ASSERT_FALSE(scenes.empty()) << "no .glb or .gltf file in " << named;
  }

  /// Runs `izb COMMAND SCENE ...` on the scene's own view and returns its JSON.
  nlohmann::json run(const char* command, const fs::path& scene, std::vector<std::string> more,
                     const RunOptions& options = {}) const {
    const fs::path json = folder / "out.json";
    fs::remove(json);
    std::vector<std::string> words{IZB_PROGRAM, command, scene, "--size", full_hd, "--json", json};
    if (!fs::exists(views) || !read_json(views).contains(scene.stem().string())) {
      ADD_FAILURE() << "no view '" << scene.stem().string() << "' in " << views;
      return {};
    }
    const std::vector<std::string> view{"--views", views, "--viewpoint", scene.stem()};
    words.insert(words.end(), view.begin(), view.end());
    words.insert(words.end(), more.begin(), more.end());
    // KHR_debug is on, but for the times.
    RunOptions debug = options;
    if (std::find(more.begin(), more.end(), "--peer") == more.end()) debug.environment["IZB_GL_DEBUG"] = "1";
    const Outcome outcome = run_program(words, debug);
    EXPECT_FALSE(outcome.says("warning: GL:")) << outcome.err;
    EXPECT_EQ(outcome.code, 0) << testing::PrintToString(words) << "\n" << outcome.out << outcome.err;
    return fs::exists(json) ? read_json(json) : nlohmann::json();
  }
};

TEST_F(Bars, NothingUnexplained) {
  std::printf("%-8s %-28s %9s %9s %9s %9s %11s\n", "context", "scene", "compared", "shadowed", "disputed", "explained",
              "unexplained");
  for (const fs::path& scene : scenes)
    for (const char* context : {"egl", "osmesa"}) {
      const nlohmann::json j = run("validate", scene, {"--context", context});
      if (j.is_null()) continue;
      const double compared = j["compared"], disputed = j["disputed"];
      std::printf("%-8s %-28s %9.0f %9d %9.0f %9d %11d\n", context, scene.stem().c_str(), compared,
                  j["shadowed"].get<int>(), disputed, j["explained"].get<int>(), j["unexplained"].get<int>());
      EXPECT_EQ(j["unexplained"], 0) << scene;
      EXPECT_LE(disputed, 1e-4 * compared) << scene;
      EXPECT_EQ(j["points"]["wrong"], 0) << scene;
      EXPECT_LT(j["points"]["max_plane_ulps"].get<double>(), 4.0) << scene;
    }
}

TEST_F(Bars, SameMask) {
  const std::pair<std::vector<std::string>, RunOptions> variants[] = {
      {{"--context", "osmesa"}, {}},
      {{"--grid", "256"}, {}},
      {{"--grid", "512"}, {}},
      {{"--grid", "1024"}, {}},
      {{"--grid", "4096"}, {}},
      {{"--zcull", "off"}, {}},
      {{}, {{{"LP_NUM_THREADS", "0"}}, false}},
      {{}, {{{"LP_NUM_THREADS", "1"}}, false}},
      {{}, {{{"LP_NUM_THREADS", "2"}}, false}},
  };
  for (const fs::path& scene : scenes) {
    const nlohmann::json first = run("render", scene, {"--context", "egl"});
    if (first.is_null()) continue;
    const std::string hash = first.value("mask_hash", "none");
    std::printf("%-28s %s\n", scene.stem().c_str(), hash.c_str());
    for (const auto& [words, options] : variants)
      EXPECT_EQ(run("render", scene, words, options).value("mask_hash", ""), hash)
          << scene << testing::PrintToString(words) << testing::PrintToString(options.environment);
    for (int again = 1; again < 10; ++again)
      EXPECT_EQ(run("render", scene, {}).value("mask_hash", ""), hash) << scene << ", run " << again;
  }
}

TEST_F(Bars, ZCullSaves) {
  std::vector<double> saved;
  std::printf("%-28s %12s %12s %7s\n", "scene", "fragments", "after z-cull", "saved");
  for (const fs::path& scene : scenes) {
    const nlohmann::json j = run("render", scene, {});
    if (j.is_null()) continue;
    const nlohmann::json& counts = j["counts"];
    const double all = counts["fragments"], after = counts["fragments_after_zcull"];
    saved.push_back(1.0 - after / all);
    std::printf("%-28s %12.0f %12.0f %6.1f%%\n", scene.stem().c_str(), all, after, 100.0 * saved.back());
    EXPECT_LT(after, all) << scene;
  }
  std::printf("median: %.1f%%\n", 100.0 * median(saved));
  EXPECT_GE(median(saved), 0.25);
}

TEST_F(Bars, Cost) {
  std::vector<double> ratios;
  std::printf("%-28s %10s %9s %9s %9s %7s %9s %9s\n", "scene", "triangles", "frame ms", "shadow ms", "peer ms", "ratio",
              "IZB MB", "B a pixel");
  for (const fs::path& scene : scenes) {
    const nlohmann::json j = run("render", scene, {"--repeat", "5", "--peer", "on"});
    if (j.is_null()) continue;
    double sum = 0.0, shadow = 0.0;
    for (const auto& stage : j["stages"]) {
      const std::string name = stage["name"];
      const double ms = stage["gpu_ms"];
      sum += ms;
      if (name != "gbuffer" && name != "shade") shadow += ms;
    }
    const double frame = j["frame_ms"], peer = j["peer"]["fastest_rebuild_plus_trace_ms"];
    const double izb_mb = j["memory_bytes"]["izb"].get<double>() * 1e-6;
    const double pixel_bytes = j["memory_bytes"]["gbuffer"].get<double>() / (1920.0 * 1080.0);
    const int triangles = j["scene"]["triangles"];
    std::printf("%-28s %10d %9.1f %9.1f %9.1f %7.2f %9.1f %9.1f\n", scene.stem().c_str(), triangles, frame, shadow,
                peer, shadow / peer, izb_mb, pixel_bytes);
    if (triangles >= 100'000 && triangles <= 1'000'000) ratios.push_back(shadow / peer);
    EXPECT_LE(std::abs(sum - frame), 0.05 * frame) << scene;
    EXPECT_LE(izb_mb, 72.0) << scene;
    EXPECT_LE(pixel_bytes, 48.0) << scene;
  }
  if (ratios.empty()) return;
  std::printf("median ratio of the scenes of 100 k to 1 M triangles: %.2f\n", median(ratios));
  EXPECT_LE(median(ratios), 5.0);
}

}  // namespace
