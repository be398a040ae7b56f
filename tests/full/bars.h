// SPDX-License-Identifier: MIT
// What the bars run: the program on every .glb and .gltf file of the folder that $IZB_SCENES names, from the viewpoint
// of its name in bench/views.json.
#pragma once
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/run_program.h"
#include "cpu/gltf_writer.h"

namespace izb::test {

namespace fs = std::filesystem;
inline constexpr const char* full_hd = "1920x1080";
inline const fs::path views = IZB_SOURCE_DIR "/bench/views.json";

inline double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const size_t n = values.size();
  return n == 0 ? 0.0 : 0.5 * (values[(n - 1) / 2] + values[n / 2]);
}

struct Bars : testing::Test {
  const TemporaryFolder folder;
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
    const fs::path written = folder / "out.json";
    fs::remove(written);
    std::vector<std::string> words{IZB_PROGRAM, command, scene, "--size", full_hd, "--json", written};
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
    return fs::exists(written) ? read_json(written) : nlohmann::json();
  }

  using Variant = std::pair<std::vector<std::string>, RunOptions>;

  /// The mask of each scene by `words` is the same for each variant of them, and in ten runs.
  void expect_same_mask(const std::vector<std::string>& words, const std::vector<Variant>& variants) const {
    for (const fs::path& scene : scenes) {
      const std::string hash = run("render", scene, words).value("mask_hash", "none");
      std::printf("%-28s %s\n", scene.stem().c_str(), hash.c_str());
      for (auto [more, options] : variants) {
        more.insert(more.begin(), words.begin(), words.end());
        EXPECT_EQ(run("render", scene, more, options).value("mask_hash", ""), hash)
            << scene << testing::PrintToString(more) << testing::PrintToString(options.environment);
      }
      for (int again = 1; again < 10; ++again)
        EXPECT_EQ(run("render", scene, words).value("mask_hash", ""), hash) << scene << ", run " << again;
    }
  }
};

/// Sum of the shadow stages' medians in ms; `all`: of all stages.
inline double stages_ms(const nlohmann::json& j, bool all = false) {
  double sum = 0.0;
  for (const auto& stage : j["stages"])
    if (all || (stage["name"] != "gbuffer" && stage["name"] != "shade")) sum += stage["gpu_ms"].get<double>();
  return sum;
}

}  // namespace izb::test
