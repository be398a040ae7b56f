// SPDX-License-Identifier: MIT
// What a run leaves behind, read by a program that is not ours where there is one.
#include <gtest/gtest.h>

#include <bit>
#include <nlohmann/json.hpp>
#include <regex>

#include "base/sha256.h"
#include "cli/run_program.h"
#include "cli/small_scenes.h"
#include "image/exr.h"
#include "image/png.h"

namespace {

namespace fs = std::filesystem;
using namespace izb::test;

/// The text that oiiotool prints for `words`.
std::string oiiotool(std::vector<std::string> words) {
  words.insert(words.begin(), "oiiotool");
  const Outcome outcome = run_program(words);
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  return outcome.out;
}

bool have_oiiotool() {
  return run_program({"oiiotool", "--version"}).code == 0;
}

struct Output : testing::Test {
  const TemporaryFolder folder;
  const fs::path scene = write_file(folder / "roof.glb", roof_over_floor().glb());
  const fs::path exr = folder / "frame.exr", png = folder / "frame.png", json = folder / "frame.json";

  Outcome render(std::vector<std::string> more = {}) const {
    std::vector<std::string> words{"render", scene, "-o",     exr,     "--preview", png,
                                   "--json", json,  "--size", "64x36", "--grid",    "256"};
    words.insert(words.end(), more.begin(), more.end());
    return izb::test::izb(words);
  }
};

TEST_F(Output, IsReadByOiiotool) {
  if (!have_oiiotool()) GTEST_SKIP() << "no oiiotool";
  const Outcome outcome = render();
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const std::string info = oiiotool({"--info", "-v", exr});
  EXPECT_NE(info.find("64 x   36"), std::string::npos) << info;
  for (const char* channel :
       {"R", "G", "B", "visibility", "depth", "normal.X", "normal.Y", "normal.Z", "mask", "list_length"})
    EXPECT_TRUE(std::regex_search(info, std::regex(std::string("channel list:.*\\b") + channel + "\\b")))
        << channel << info;
  EXPECT_TRUE(std::regex_search(info, std::regex("channel list:.*mask \\(uint\\)"))) << info;
  for (const char* attribute : {"worldToCamera", "worldToNDC", "izb.command", "izb.version", "izb.gl", "izb.options",
                                "izb.stages", "izb.mask_hash", "light.type", "light.direction", "light.color"})
    EXPECT_NE(info.find(attribute), std::string::npos) << attribute << "\n" << info;
  EXPECT_NE(oiiotool({"--info", png}).find("64 x   36, 3 channel, uint8 png"), std::string::npos);
  const std::string stats = oiiotool({exr, "--ch", "visibility,depth,normal.X,R", "--printstats"});
  EXPECT_NE(stats.find("NanCount: 0 0 0 0"), std::string::npos) << stats;
  EXPECT_NE(stats.find("InfCount: 0 0 0 0"), std::string::npos) << stats;
  EXPECT_TRUE(std::regex_search(stats, std::regex("Stats Min: 0\\.0+ "))) << stats;  // something is shadowed
  EXPECT_TRUE(std::regex_search(stats, std::regex("Stats Max: 1\\.0+ "))) << stats;  // something is lit
}

TEST_F(Output, MaskIsTheRoofsShadowAndTheHashIsOfIt) {
  ASSERT_EQ(render().code, 0);
  const izb::Image image = izb::read_exr(exr);
  const std::vector<uint32_t>& mask = image.uints("mask");
  const std::vector<float>&depth = image.floats("depth"), &visibility = image.floats("visibility");
  EXPECT_EQ(izb::sha256_hex(std::as_bytes(std::span(mask))), read_json(json)["mask_hash"]);
  double shadowed = 0.0;
  for (size_t i = 0; i < mask.size(); ++i) {
    EXPECT_EQ(visibility[i], 1.0f - float(std::popcount(mask[i])) / 32.0f) << i;
    if (depth[i] == 0.0f) {
      EXPECT_EQ(mask[i], 0u) << i;
    }
    shadowed += std::popcount(mask[i]) / 32.0;
  }
  // The roof covers 2 x 2 of the floor, seen by 45 degrees from about 11 units: a part of it is hidden by the
  // roof.
  const double pixel = 11.3 * 2.0 * std::tan(0.45) / 36.0;
  EXPECT_GT(shadowed, 0.3 * 4.0 * std::sqrt(0.5) / (pixel * pixel));
  EXPECT_LT(shadowed, 1.2 * 4.0 * std::sqrt(0.5) / (pixel * pixel));
}

TEST_F(Output, WorldToNdcLeadsToThePixelsThatTheCameraSees) {
  ASSERT_EQ(render().code, 0);
  const izb::Image image = izb::read_exr(exr);
  const auto& m = std::get<std::array<float, 16>>(image.attributes.at("worldToNDC"));
  const auto ndc = [&](float x, float y, float z) {  // row vectors
    std::array<float, 4> p{};
    for (size_t c = 0; c < 4; ++c) p[c] = x * m[c] + y * m[4 + c] + z * m[8 + c] + m[12 + c];
    return std::array<float, 2>{p[0] / p[3], p[1] / p[3]};
  };
  // The camera at (0, 8, 8) looks at the origin; what is nearer to it lies lower in the picture.
  EXPECT_NEAR(ndc(0, 0, 0)[0], 0.5, 1e-5);
  EXPECT_NEAR(ndc(0, 0, 0)[1], 0.5, 1e-5);
  EXPECT_GT(ndc(0, 0, 1)[1], 0.5);
  EXPECT_GT(ndc(1, 0, 0)[0], 0.5);
}

TEST_F(Output, JsonHasTheDocumentedKeys) {
  ASSERT_EQ(render({"--repeat", "3"}).code, 0);
  const nlohmann::json j = read_json(json);
  for (const char* key :
       {"stages", "counts", "memory_bytes", "gl", "options", "command", "version", "mask_hash", "timing", "frame_ms"})
    EXPECT_TRUE(j.contains(key)) << key;
  std::vector<std::string> stages;
  for (const auto& stage : j["stages"]) {
    stages.push_back(stage["name"]);
    EXPECT_EQ(stage["samples"].size(), 3u);
    EXPECT_GE(stage["gpu_ms"].get<double>(), 0.0);
  }
  EXPECT_EQ(stages,
            (std::vector<std::string>{"gbuffer", "bounds", "occluders", "build", "zcull", "visibility", "shade"}));
  for (const char* count : {"fragments", "fragments_after_zcull", "visibility_tests", "nodes", "longest_list"})
    EXPECT_TRUE(j["counts"].contains(count)) << count;
  EXPECT_TRUE(j["timing"] == "wall" || j["timing"] == "query");
  EXPECT_EQ(j["options"]["grid"], 256);
  EXPECT_EQ(j["options"]["repeat"], 3);
  EXPECT_EQ(j["options"]["peer"], false);
  EXPECT_NE(j["command"].get<std::string>().find("izb render "), std::string::npos);
  EXPECT_EQ(j["mask_hash"].get<std::string>().size(), 64u);
}

TEST_F(Output, TheListHistogramAddsUpToTheCounts) {
  for (const std::vector<std::string>& words : {std::vector<std::string>{"--spp", "1", "--occluders", "off"},
                                                {"--spp", "32", "--cascades", "2", "--removal", "off"}}) {
    ASSERT_EQ(render(words).code, 0);
    const nlohmann::json j = read_json(json), counts = j["counts"], averages = j["averages"];
    const auto histogram = j["list_histogram"].get<std::vector<uint64_t>>();
    uint64_t lists = 0, nodes = 0;
    for (size_t n = 1; n < histogram.size(); ++n) lists += histogram[n], nodes += n * histogram[n];
    EXPECT_GT(nodes, 0u);
    EXPECT_EQ(nodes, counts["nodes"]);
    EXPECT_EQ(lists, counts["lists"]);
    EXPECT_EQ(histogram.size() - 1, counts["longest_list"]);
    EXPECT_EQ(histogram[0] + lists, 256u * 256u * (words[1] == "1" ? 1u : 2u));

    uint64_t fully_shadowed = 0;
    const izb::Image image = izb::read_exr(exr);
    for (const uint32_t word : image.uints("mask")) fully_shadowed += word == ~0u;
    EXPECT_GT(fully_shadowed, 0u);
    EXPECT_EQ(counts["fully_shadowed"], fully_shadowed);
    EXPECT_GT(counts["receivers"], fully_shadowed);
    if (words[1] == "1") {
      EXPECT_EQ(counts["receivers"], nodes);  // one node each
    }
    const auto of = [&](const char* name) { return counts[name].get<double>(); };
    EXPECT_DOUBLE_EQ(averages["nodes_a_receiver"], of("nodes") / of("receivers"));
    EXPECT_DOUBLE_EQ(averages["nodes_a_list"], of("nodes") / of("lists"));
    EXPECT_DOUBLE_EQ(averages["tests_a_fragment"], of("visibility_tests") / of("fragments_after_zcull"));
    EXPECT_DOUBLE_EQ(averages["tests_a_receiver"], of("visibility_tests") / of("receivers"));
  }
}

TEST_F(Output, MemoryIsPrintedAndInTheJson) {
  const Outcome outcome = render();
  ASSERT_EQ(outcome.code, 0);
  const nlohmann::json j = read_json(json);
  for (const char* group : {"izb", "gbuffer", "scene"}) EXPECT_GT(j["memory_bytes"][group], 0) << group;
  EXPECT_EQ(j["memory_bytes"]["gbuffer"], 64 * 36 * (40 + 16));  // with the micro-quad
  EXPECT_TRUE(std::regex_search(outcome.out, std::regex("\nmemory: gbuffer 0\\.1 MB, izb .* MB, scene .* MB; .* MB")))
      << outcome.out;
  EXPECT_GT(j["memory_peak_bytes"], 10'000'000);
  EXPECT_GT(j["memory_peak_bytes"], j["scene"]["geometry_bytes"]);
  if (!j["memory_available_bytes"].is_null()) {
    EXPECT_TRUE(outcome.prints(" MB available")) << outcome.out;
  }
}

TEST_F(Output, TechniquesWriteTheSameLayoutAndHereTheSameMask) {
  ASSERT_EQ(render({"--spp", "1"}).code, 0);
  const std::string hash = read_json(json)["mask_hash"];
  for (std::vector<std::string> words :
       {std::vector<std::string>{"--zcull", "off"}, {"--grid", "1024"}, {"--context", "osmesa"}}) {
    words.insert(words.end(), {"--spp", "1"});
    const Outcome outcome = render(words);
    if (outcome.says("this build has no")) continue;
    ASSERT_EQ(outcome.code, 0) << words[0] << outcome.err;
    EXPECT_EQ(read_json(json)["mask_hash"], hash) << words[0];
  }
  std::vector<std::string> words{"render", scene,   "-o",          exr,          "--json", json,
                                 "--size", "64x36", "--technique", "ray_traced", "--spp",  "1"};
  const Outcome outcome = izb::test::izb(words);
  if (outcome.says("Embree") && outcome.code == 1) GTEST_SKIP() << "this build has no Embree";
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const izb::Image image = izb::read_exr(exr);
  for (const uint32_t word : image.uints("mask")) EXPECT_TRUE(word == 0 || word == 0xffffffffu);
  EXPECT_EQ(read_json(json)["mask_hash"], hash);
}

TEST_F(Output, APathThatIsNotUtf8IsNoObstacle) {
  const fs::path odd = write_file(folder / "odd\xff.glb", roof_over_floor().glb());
  const Outcome outcome = izb::test::izb({"render", odd, "-o", exr, "--json", json, "--size", "32x18"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(read_json(json)["scene"]["file"].get<std::string>().ends_with("odd\xef\xbf\xbd.glb"));
}

TEST_F(Output, ASpotsConesAreAttributes) {
  ASSERT_EQ(render({"--spot", "0,6,0,0,0,0,40"}).code, 0);
  const izb::Image image = izb::read_exr(exr);
  EXPECT_FLOAT_EQ(std::get<float>(image.attributes.at("light.halfAngleDegrees")), 40.0f);
  EXPECT_FLOAT_EQ(std::get<float>(image.attributes.at("light.innerHalfAngleDegrees")), 36.0f);
}

TEST_F(Output, NothingInViewIsTheSkyWithAWarning) {
  const Outcome outcome = render({"--eye", "0,5,0", "--target", "0,50,1"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(outcome.says("warning")) << outcome.err;
  EXPECT_TRUE(outcome.says("in view")) << outcome.err;
  const izb::Image image = izb::read_exr(exr);
  for (const uint32_t word : image.uints("mask")) EXPECT_EQ(word, 0u);
  for (const char* name : {"R", "G", "B", "depth"})
    for (const float value : image.floats(name)) ASSERT_TRUE(std::isfinite(value)) << name;
}

TEST_F(Output, WhatIsMissingInTheSceneIsSaid) {
  const fs::path bare = write_file(folder / "bare.glb", one_triangle().glb());
  const Outcome outcome = izb::test::izb({"render", bare, "-o", exr, "--size", "32x18"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(outcome.says("no camera")) << outcome.err;
  EXPECT_TRUE(outcome.says("light")) << outcome.err;
}

TEST_F(Output, ReportsGoToStdoutAndNoProgressToAFile) {
  const Outcome outcome = render();
  ASSERT_EQ(outcome.code, 0);
  for (const char* text : {"gbuffer", "visibility", "frame.exr", "frame.png", "frame.json"})
    EXPECT_TRUE(outcome.prints(text)) << text;
  EXPECT_EQ(outcome.err.find('\r'), std::string::npos) << outcome.err;
  EXPECT_EQ(names_in(folder / "."), (std::vector<std::string>{"frame.exr", "frame.json", "frame.png", "roof.glb"}));
}

TEST_F(Output, ValidateAgreesAndWritesItsNumbers) {
  const Outcome outcome =
      izb::test::izb({"validate", scene, "--spp", "1", "--size", "64x36", "--json", json, "--heatmap", png});
  if (outcome.says("Embree") && outcome.code == 1) GTEST_SKIP() << "this build has no Embree";
  ASSERT_EQ(outcome.code, 0) << outcome.out << outcome.err;
  const nlohmann::json j = read_json(json);
  for (const char* key : {"pixels", "spp", "shrunk_pixels", "lit", "shadowed", "disputed", "explained", "unexplained",
                          "leaks", "false_shadow"})
    EXPECT_TRUE(j.contains(key)) << key;
  EXPECT_EQ(j["pixels"], 64 * 36);
  EXPECT_EQ(j["unexplained"], 0);
  EXPECT_GT(j["shadowed"], 0);
  EXPECT_GT(j["lit"], 0);
  EXPECT_EQ(j["lit"].get<int>() + j["shadowed"].get<int>() + j["left_out"]["sky"].get<int>() +
                j["left_out"]["culled"].get<int>() + j["left_out"]["outside_cone"].get<int>(),
            64 * 36);
  EXPECT_TRUE(outcome.prints("unexplained"));
  if (have_oiiotool()) {
    EXPECT_NE(oiiotool({"--info", png}).find("64 x   36"), std::string::npos);
  }
}

TEST_F(Output, ValidateCountsBitsOf32SamplesAPixel) {
  // Off the scene's own camera, whose pixels' borders meet the roof's silhouette.
  const Outcome outcome =
      izb::test::izb({"validate", scene, "--size", "64x36", "--eye", "0,8,8.1", "--target", "0,0,0", "--json", json,
                      "--heatmap", png, "--technique", "ray_traced", "--spp", "32", "--model", "on"});
  if (outcome.says("Embree") && outcome.code == 1) GTEST_SKIP() << "this build has no Embree";
  ASSERT_EQ(outcome.code, 0) << outcome.out << outcome.err;
  const nlohmann::json j = read_json(json);
  EXPECT_EQ(j["spp"], 32);
  EXPECT_EQ(j["shrunk_pixels"], 0);  // the floor is seen from above
  EXPECT_EQ(j["unexplained"], 0);
  EXPECT_EQ(j["pixels"], 64 * 36);
  const int left_out = j["left_out"]["sky"].get<int>() + j["left_out"]["culled"].get<int>();
  EXPECT_EQ(j["compared"], 32 * (64 * 36 - left_out));
  EXPECT_EQ(j["lit"].get<int>() + j["shadowed"].get<int>(), j["compared"]);
  EXPECT_NE(j["shadowed"].get<int>() % 32, 0);  // a part of some pixels
  EXPECT_FALSE(j.contains("attribution"));      // rays approximate nothing
  EXPECT_GT(j["model"]["compared"], j["compared"].get<int>() / 2);
  EXPECT_GT(j["model"]["differing"], 0);  // at the roof's silhouette
  EXPECT_LT(j["model"]["percent"], 10.0);
  EXPECT_TRUE(outcome.prints("model %"));
}

TEST_F(Output, ValidateCountsWhatADepthMapHasWrong) {
  int unexplained[2] = {};
  for (const int k : {0, 1}) {
    const Outcome outcome =
        izb::test::izb({"validate", scene,      "--size",      "64x36",        "--eye",
                        "0,8,8.1",  "--target", "0,0,0",       "--sun",        "330,50",
                        "--json",   json,       "--technique", "shadow_map",   "--spp",
                        "32",       "--filter", "none",        "--resolution", k == 0 ? "64" : "4096"});
    if (outcome.says("Embree") && outcome.code == 1) GTEST_SKIP() << "this build has no Embree";
    const nlohmann::json j = read_json(json);
    unexplained[k] = j["unexplained"];
    EXPECT_EQ(outcome.code, unexplained[k] == 0 ? 0 : 1) << outcome.err;
    EXPECT_GT(j["shadowed"], 0);
    EXPECT_FALSE(j.contains("attribution"));
    EXPECT_EQ(j["points"]["wrong"], 0);
  }
  // Texels of 1/6 and 1/400 unit along the 8 units of the roof's border. Measured: 88 and 0.
  EXPECT_GT(unexplained[0], 20);
  EXPECT_LT(unexplained[1], unexplained[0] / 10);
}

TEST_F(Output, ValidateAttributesTheWrongBitsOfApproximations) {
  const auto validate = [&](const std::string& coverage, const std::string& insertion) {
    return izb::test::izb({"validate", scene, "--size", "64x36", "--eye", "0,8,8.1", "--target", "0,0,0", "--json",
                           json, "--spp", "32", "--coverage", coverage, "--insertion", insertion});
  };
  const Outcome outcome = validate("lut", "approximate");
  if (outcome.says("Embree") && outcome.code == 1) GTEST_SKIP() << "this build has no Embree";
  ASSERT_EQ(outcome.code, 0) << outcome.out << outcome.err;
  const nlohmann::json j = read_json(json);
  EXPECT_EQ(j["options"]["coverage"], "lut");
  EXPECT_EQ(j["options"]["insertion"], "approximate");
  EXPECT_GT(j["attribution"]["table"], 0);
  EXPECT_EQ(j["attribution"]["shadowed_bits"], j["shadowed"]);
  EXPECT_TRUE(outcome.prints("leak %"));
  // The exact mask is the settled one: the table's wrong bits are no disputes.
  const std::string with_table = j["mask_hash"];
  ASSERT_EQ(validate("exact", "exact").code, 0);
  const nlohmann::json exact = read_json(json);
  EXPECT_FALSE(exact.contains("attribution"));
  EXPECT_NE(exact["mask_hash"], with_table);
  for (const char* key : {"lit", "shadowed", "disputed", "explained", "unexplained"})
    EXPECT_EQ(exact[key], j[key]) << key;
}

TEST_F(Output, ValidateWritesAHeatMapOfEachScene) {
  const fs::path other = write_file(folder / "other.glb", roof_over_floor().glb());
  const Outcome outcome =
      izb::test::izb({"validate", scene, other, "--size", "64x36", "--json", json, "--heatmap", folder / "map.png"});
  if (outcome.says("Embree") && outcome.code == 1) GTEST_SKIP() << "this build has no Embree";
  ASSERT_EQ(outcome.code, 0) << outcome.out << outcome.err;
  EXPECT_EQ(names_in(folder / "."),
            (std::vector<std::string>{"frame.json", "map.other.png", "map.roof.png", "other.glb", "roof.glb"}));
  EXPECT_EQ(read_json(json).size(), 2u);
  const izb::Image8 map = izb::read_png(folder / "map.roof.png");
  EXPECT_EQ(map.width_px, 64);
  EXPECT_EQ(map.pixels, izb::read_png(folder / "map.other.png").pixels);
}

TEST_F(Output, ValidateFailsOnAPlantedError) {
  // A copy of the shaders that loses all shadow.
  const fs::path glsl = folder / "glsl";
  fs::copy(IZB_SOURCE_DIR "/glsl", glsl, fs::copy_options::recursive);
  const fs::path file = glsl / "shadow/izb/receivers.glsl";
  std::stringstream text;
  text << std::ifstream(file).rdbuf();
  std::string edited = text.str();
  const std::string store = "imageStore(mask, px, uvec4(bits))";
  const size_t at = edited.find(store);
  ASSERT_NE(at, std::string::npos);
  edited.replace(at, store.size(), "imageStore(mask, px, uvec4(0u))");
  std::ofstream(file) << edited;
  const Outcome outcome =
      izb::test::izb({"validate", scene, "--spp", "1", "--occluders", "off", "--size", "64x36", "--json", json},
                     {{{"IZB_GLSL", glsl}}, false});
  if (outcome.says("Embree") && outcome.code == 1) GTEST_SKIP() << "this build has no Embree";
  EXPECT_EQ(outcome.code, 1) << outcome.err;
  const nlohmann::json j = read_json(json);
  EXPECT_GE(j["unexplained"], 10);  // all of the roof's shadow
  EXPECT_EQ(j["unexplained"], j["leaks"]);
}

TEST_F(Output, InfoSaysThatBlendIsOpaque) {
  GltfWriter gltf = roof_over_floor();
  gltf.root["materials"] = {{{"alphaMode", "BLEND"}}};
  gltf.root["meshes"][0]["primitives"][0]["material"] = 0;
  const Outcome outcome = izb::test::izb({"info", write_file(folder / "glass.glb", gltf.glb())});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(outcome.prints("1 blended, which cast and receive as opaque")) << outcome.out;
}

TEST_F(Output, InfoTellsTheContextAndTheScene) {
  const Outcome outcome = izb::test::izb({"info", scene});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  for (const char* text : {"context egl", "platform: ", "renderer", "GL_MAX_TEXTURE_SIZE", "memory available",
                           "triangles", "4 placed", "above", "noon"})
    EXPECT_TRUE(outcome.prints(text)) << text << "\n" << outcome.out;
}

TEST_F(Output, SceneWritesWhatTheProgramReads) {
  const fs::path garden = folder / "garden.glb", again = folder / "again.glb";
  ASSERT_EQ(izb::test::izb({"scene", "garden", "-o", garden}).code, 0);
  ASSERT_EQ(izb::test::izb({"scene", "garden", "-o", again}).code, 0);
  EXPECT_EQ(run_program({"cmp", garden, again}).code, 0) << "the same seed must give the same file";
  const Outcome outcome = izb::test::izb({"info", garden});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(outcome.prints("sunset")) << outcome.out;
}

}  // namespace
