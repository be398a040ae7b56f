// SPDX-License-Identifier: MIT
// Real scenes: every .glb and .gltf file of the folder that $IZB_SCENES names, from the view of its name in
// bench/views.json where there is one. Small size here; tests/full has the stated one.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/run_program.h"
#include "cpu/gltf_writer.h"

namespace izb::test {
namespace {

namespace fs = std::filesystem;

const fs::path views = IZB_SOURCE_DIR "/bench/views.json";

/// File names, read when the tests are listed.
std::vector<std::string> scene_names() {
  std::vector<std::string> names;
  if (const char* folder = std::getenv("IZB_SCENES"); folder && fs::is_directory(folder))
    for (const std::string& name : names_in(folder))
      if (name.ends_with(".glb") || name.ends_with(".gltf")) names.push_back(name);
  if (names.empty()) names.push_back("IZB_SCENES is not set");
  return names;
}

class Scenes : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    if (GetParam() == "IZB_SCENES is not set") GTEST_SKIP() << GetParam();
  }

  nlohmann::json run(const std::string& command, const std::vector<std::string>& more) const {
    const fs::path scene = fs::path(std::getenv("IZB_SCENES")) / GetParam();
    const fs::path json = folder_ / "out.json";
    std::vector<std::string> words{command, scene, "--size", "480x270", "--json", json};
    words.insert(words.end(), more.begin(), more.end());
    const nlohmann::json known = nlohmann::json::parse(std::ifstream(views));
    if (known.contains(scene.stem().string())) {
      const std::vector<std::string> view{"--views", views, "--viewpoint", scene.stem()};
      words.insert(words.end(), view.begin(), view.end());
    }
    const Outcome outcome = izb(words, {{{"IZB_GL_DEBUG", "1"}}, false});
    EXPECT_EQ(outcome.code, 0) << outcome.out << outcome.err;
    EXPECT_FALSE(outcome.says("warning: GL:")) << outcome.err;
    return fs::exists(json) ? nlohmann::json::parse(std::ifstream(json)) : nlohmann::json::object();
  }

  const TemporaryFolder folder_;
};

TEST_P(Scenes, NoBitIsUnexplainedAndBothContextsAgree) {
  const nlohmann::json egl = run("validate", {"--context", "egl", "--spp", "1"});
  ASSERT_TRUE(egl.contains("unexplained"));
  EXPECT_EQ(egl["unexplained"], 0);
  EXPECT_EQ(egl["points"]["wrong"], 0);
  // A few ulps: the receiver point is rounded once, its coordinates once more.
  EXPECT_LT(egl["points"]["max_plane_ulps"], 4.0);
  EXPECT_LT(egl["points"]["max_lift_px"], 0.501);
  EXPECT_GT(egl["compared"], 1000);
  // 10^-4 is the bar at 1920 x 1080; the plane's bias is a share of a pixel, and a pixel is four times as wide here.
  EXPECT_LE(egl["disputed"].get<double>(), std::max(3.0, 4e-4 * egl["compared"].get<double>()));

  const nlohmann::json osmesa = run("render", {"--context", "osmesa", "--spp", "1"});
  EXPECT_EQ(osmesa.value("mask_hash", "none"), egl["mask_hash"]);
  EXPECT_LT(osmesa["counts"]["fragments_after_zcull"], osmesa["counts"]["fragments"]);
}

// Two cascades, so that the seam between them is in the picture; a small grid, since a pixel is large here.
TEST_P(Scenes, NoBitIsUnexplainedAt32SamplesByTheExactModes) {
  const nlohmann::json j =
      run("validate", {"--preset", "exact", "--cascades", "2", "--grid", "512", "--points", "off"});
  ASSERT_TRUE(j.contains("unexplained"));
  EXPECT_EQ(j["unexplained"], 0);
  EXPECT_GT(j["compared"], 32000);
}

// By default, with all approximations: the exact twin is right, and few bits leak at a size where micro-quads are
// large.
TEST_P(Scenes, ApproximateInsertionLeaksLittle) {
  const nlohmann::json j = run("validate", {"--grid", "512", "--points", "off"});
  ASSERT_TRUE(j.contains("attribution"));
  EXPECT_EQ(j["unexplained"], 0);
  EXPECT_LT(j["attribution"]["leak_percent"], 0.5);
}

INSTANTIATE_TEST_SUITE_P(Files, Scenes, testing::ValuesIn(scene_names()), [](const auto& file) {
  std::string name = fs::path(file.param).stem();
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  return name;
});

}  // namespace
}  // namespace izb::test
