// SPDX-License-Identifier: MIT
// Every procedural scene at about 100,000 triangles by the exact modes, small here; tests/full has the stated size.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/run_program.h"
#include "cpu/gltf_writer.h"

namespace izb::test {
namespace {

namespace fs = std::filesystem;

struct Case {
  const char* scene;
  std::vector<std::string> more{};  ///< a moment, where something deforms
};

class ProceduralImages : public testing::TestWithParam<Case> {};

TEST_P(ProceduralImages, NoBitIsUnexplainedByTheExactModes) {
  const TemporaryFolder folder;
  const fs::path scene = folder / "scene.glb", json = folder / "out.json";
  ASSERT_EQ(izb({"scene", GetParam().scene, "--triangles", "100000", "-o", scene}).code, 0);
  std::vector<std::string> words{"validate", scene,    "--camera", "main",   "--size", "240x135",  "--preset",
                                 "exact",    "--grid", "512",      "--json", json,     "--points", "off"};
  words.insert(words.end(), GetParam().more.begin(), GetParam().more.end());
  const Outcome outcome = izb(words, {{{"IZB_GL_DEBUG", "1"}}, false});
  EXPECT_EQ(outcome.code, 0) << outcome.out << outcome.err;
  EXPECT_FALSE(outcome.says("warning: GL:")) << outcome.err;
  ASSERT_TRUE(fs::exists(json));
  const nlohmann::json j = nlohmann::json::parse(std::ifstream(json));
  EXPECT_EQ(j["unexplained"], 0);
  EXPECT_GT(j["compared"], 100000);
  EXPECT_GT(j["shadowed"], 10000);
}

INSTANTIATE_TEST_SUITE_P(All, ProceduralImages,
                         testing::Values(Case{"villa"}, Case{"town"}, Case{"terrain"}, Case{"hairball"},
                                         Case{"furball"}, Case{"grass"}, Case{"powerplant"}, Case{"plane"},
                                         Case{"tentacles", {"--time", "1.7"}}, Case{"character", {"--time", "2.4"}}),
                         [](const auto& scene) { return std::string{scene.param.scene}; });

// The camera that flies through each scene sees something else at another moment, and the fixed one does not.
TEST(ProceduralPath, MovesItsOwnCameraOnly) {
  const TemporaryFolder folder;
  const fs::path scene = folder / "villa.glb", json = folder / "out.json";
  ASSERT_EQ(izb({"scene", "villa", "--triangles", "8000", "-o", scene}).code, 0);
  const auto hash = [&](const char* camera, const char* time_s) {
    const Outcome outcome = izb({"render", scene, "--camera", camera, "--time", time_s, "--animation", "path", "--size",
                                 "96x54", "-o", folder / "out.exr", "--json", json});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return nlohmann::json::parse(std::ifstream(json))["mask_hash"].get<std::string>();
  };
  EXPECT_EQ(hash("main", "2"), hash("main", "9"));
  EXPECT_NE(hash("path", "2"), hash("path", "9"));
}

}  // namespace
}  // namespace izb::test
