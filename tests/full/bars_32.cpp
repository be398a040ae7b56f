// SPDX-License-Identifier: MIT
// The bars of 32 samples a pixel at their stated sizes on real scenes. Prints its numbers.
#include <numeric>

#include "full/bars.h"

namespace izb::test {
namespace {

using Bars32 = Bars;

TEST_F(Bars32, NothingUnexplained) {
  std::printf("%-28s %8s %10s %10s %9s %9s %11s %8s\n", "scene", "cascades", "compared", "shadowed", "disputed",
              "explained", "unexplained", "shrunk");
  for (const fs::path& scene : scenes)
    for (const char* cascades : {"1", "4"}) {
      const nlohmann::json j = run("validate", scene, {"--preset", "exact", "--cascades", cascades});
      if (j.is_null()) continue;
      std::printf("%-28s %8s %10.0f %10.0f %9d %9d %11d %8d\n", scene.stem().c_str(), cascades,
                  j["compared"].get<double>(), j["shadowed"].get<double>(), j["disputed"].get<int>(),
                  j["explained"].get<int>(), j["unexplained"].get<int>(), j["shrunk_pixels"].get<int>());
      EXPECT_EQ(j["unexplained"], 0) << scene << cascades;
    }
}

// At 1280 x 720. Lights that shine all around from within each scene, several at once, and a sun at the horizon; and
// what moves, at three moments.
TEST_F(Bars32, NothingUnexplainedUnderAnyLightAtAnyTime) {
  std::printf("%-28s %-32s %10s %10s %9s %9s %11s\n", "scene", "case", "compared", "shadowed", "disputed", "explained",
              "unexplained");
  const auto check = [&](const fs::path& scene, const std::vector<std::string>& options) {
    std::vector<std::string> all{"--preset", "exact", "--size", "1280x720"};
    all.insert(all.end(), options.begin(), options.end());
    nlohmann::json reports = run("validate", scene, all);
    if (reports.is_null()) return;
    if (!reports.is_array()) reports = nlohmann::json::array({reports});
    for (const nlohmann::json& j : reports) {
      const std::string what = options.back() + " " + j["light"]["name"].get<std::string>();
      std::printf("%-28s %-32s %10.0f %10.0f %9d %9d %11d\n", scene.stem().c_str(), what.c_str(),
                  j["compared"].get<double>(), j["shadowed"].get<double>(), j["disputed"].get<int>(),
                  j["explained"].get<int>(), j["unexplained"].get<int>());
      EXPECT_EQ(j["unexplained"], 0) << scene << what;
    }
  };
  const std::vector<std::pair<std::string, std::string>> lamps{
      {"sponza_dabrovic", "2,4,0"},       {"nexuiz_aneurysm", "750,150,-1450"}, {"kicad_video_board", "110,12,115"},
      {"ldraw_xwing", "120,90,60"},       {"morse_human_rig", "0.8,1.6,0.4"},   {"0ad_obedska_bog", "835,15,-1005"},
      {"stk_black_forest", "250,30,-290"}};
  for (const fs::path& scene : scenes) {
    check(scene, {"--sun", "200,0.5"});
    for (const auto& [name, lamp] : lamps)
      if (scene.stem() == name) check(scene, {"--spot", lamp + ",0,0,0,80", "--point", lamp});
    for (const char* moving : {"morse_human_rig", "stk_tux_animated"})
      if (scene.stem() == moving)
        for (const char* time_s : {"0.3", "1.1", "2.7"}) check(scene, {"--time", time_s});
  }
}

// At 1280 x 720 and about 100,000 triangles.
TEST(ProceduralBars, NothingUnexplained) {
  const TemporaryFolder folder;
  std::printf("%-12s %10s %10s %9s %9s %11s\n", "scene", "compared", "shadowed", "disputed", "explained",
              "unexplained");
  for (const char* name :
       {"villa", "town", "terrain", "hairball", "furball", "grass", "powerplant", "plane", "tentacles", "character"}) {
    const fs::path scene = folder / "scene.glb", json = folder / "out.json";
    ASSERT_EQ(run_program({IZB_PROGRAM, "scene", name, "--triangles", "100000", "-o", scene}).code, 0) << name;
    // What deforms stands still in the others at any moment.
    for (const char* time_s : {"0.4", "3.1", "7.7"}) {
      const Outcome outcome = run_program({IZB_PROGRAM, "validate", scene, "--camera", "main", "--size", "1280x720",
                                           "--preset", "exact", "--time", time_s, "--json", json});
      EXPECT_EQ(outcome.code, 0) << name << outcome.err;
      const nlohmann::json j = read_json(json);
      std::printf("%-12s %10.0f %10.0f %9d %9d %11d\n", name, j["compared"].get<double>(), j["shadowed"].get<double>(),
                  j["disputed"].get<int>(), j["explained"].get<int>(), j["unexplained"].get<int>());
      EXPECT_EQ(j["unexplained"], 0) << name;
      if (name != std::string("tentacles") && name != std::string("character")) break;
    }
  }
}

// At 1280 x 720, on the scenes that have alpha masks: no bit unexplained, and what asking them once a fragment costs
// and saves.
TEST_F(Bars32, AlphaMasks) {
  std::printf("%-28s %10s %9s %9s %11s %12s %12s %9s\n", "scene", "shadowed", "explained", "by alpha", "unexplained",
              "alpha leaks", "alpha false", "percent");
  for (const fs::path& scene : scenes) {
    const nlohmann::json j = run("validate", scene, {"--preset", "exact", "--alpha", "fragment", "--size", "1280x720"});
    if (j.is_null() || !j.contains("attribution")) continue;  // nothing is masked
    const nlohmann::json& a = j["attribution"];
    std::printf("%-28s %10.0f %9d %9d %11d %12d %12d %8.2f%%\n", scene.stem().c_str(), j["shadowed"].get<double>(),
                j["explained"].get<int>(), j["explained_by_alpha"].get<int>(), j["unexplained"].get<int>(),
                a["alpha_leaks"].get<int>(), a["alpha_false"].get<int>(), a["alpha_percent"].get<double>());
    EXPECT_EQ(j["unexplained"], 0) << scene;
    EXPECT_EQ(j["points"]["wrong"], 0) << scene;
    EXPECT_LT(j["explained_by_alpha"].get<double>(), 1e-6 * j["compared"].get<double>()) << scene;
    EXPECT_GT(a["alpha_percent"], 1.0) << scene;
    for (const char* alpha : {"exact", "fragment", "off"}) {
      const nlohmann::json r = run("render", scene, {"--size", "1280x720", "--alpha", alpha, "--repeat", "5"});
      if (!r.is_null()) std::printf("    --alpha %-9s shadow stages %8.1f ms\n", alpha, stages_ms(r));
    }
  }
}

TEST_F(Bars32, InsertionLeaks) {
  std::vector<double> leaks, nv_leaks;
  std::printf("%-28s %10s %9s %9s %9s %9s %9s %12s\n", "scene", "shadowed", "table", "leaks", "percent", "nv leaks",
              "percent", "model differs");
  for (const fs::path& scene : scenes) {
    const nlohmann::json j = run("validate", scene, {"--model", "on"});
    const nlohmann::json nv = run("validate", scene, {"--insertion", "nv"});
    if (j.is_null() || nv.is_null()) continue;
    const nlohmann::json &a = j["attribution"], &b = nv["attribution"];
    leaks.push_back(a["leak_percent"]);
    nv_leaks.push_back(b["leak_percent"]);
    std::printf("%-28s %10.0f %9d %9d %8.4f%% %9d %8.4f%% %11.3f%%\n", scene.stem().c_str(),
                a["shadowed_bits"].get<double>(), a["table"].get<int>(), a["insertion_leaks"].get<int>(), leaks.back(),
                b["insertion_leaks"].get<int>(), nv_leaks.back(), j["model"]["percent"].get<double>());
    EXPECT_EQ(j["unexplained"], 0) << scene;
  }
  std::printf("median: %.4f%%, by N.V alone %.4f%%\n", median(leaks), median(nv_leaks));
  EXPECT_LE(median(leaks), 0.02);
  EXPECT_LT(median(leaks), median(nv_leaks));
}

TEST_F(Bars32, SameMaskWithExactInsertion) {
  expect_same_mask({"--preset", "exact"}, {{{"--context", "osmesa"}, {}},
                                           {{"--grid", "1024"}, {}},
                                           {{"--grid", "4096"}, {}},
                                           {{"--cascades", "4"}, {}},
                                           {{"--cascades", "3", "--cascade-pass", "multiple"}, {}},
                                           {{"--zcull", "off"}, {}},
                                           {{"--removal", "off"}, {}},
                                           {{"--unchanged-skip", "off"}, {}},
                                           {{"--pipelining", "on"}, {}},
                                           {{"--pairs", "0"}, {}},
                                           {{}, {{{"LP_NUM_THREADS", "0"}}, false}},
                                           {{}, {{{"LP_NUM_THREADS", "1"}}, false}}});
}

TEST_F(Bars32, SameMaskByDefaultWhereNoTexelChanges) {
  expect_same_mask({}, {{{"--context", "osmesa"}, {}},
                        {{"--removal", "off"}, {}},
                        {{"--unchanged-skip", "off"}, {}},
                        {{"--pipelining", "on"}, {}},
                        {{"--pairs", "0"}, {}},
                        {{}, {{{"LP_NUM_THREADS", "0"}}, false}}});
}

TEST_F(Bars32, Cost) {
  std::vector<double> ratios, peers, nodes;
  std::printf("%-28s %10s %9s %9s %7s %9s %7s %8s\n", "scene", "triangles", "1 spp ms", "32 spp ms", "32 / 1",
              "peer ms", "/ peer", "nodes/px");
  for (const fs::path& scene : scenes) {
    // With the peer in both, so that nothing but the samples differs.
    const nlohmann::json one = run("render", scene, {"--spp", "1", "--repeat", "5", "--peer", "on"});
    const nlohmann::json j = run("render", scene, {"--repeat", "5", "--peer", "on"});
    if (one.is_null() || j.is_null()) continue;
    const double peer = j["peer"]["fastest_rebuild_plus_trace_ms"];
    ratios.push_back(stages_ms(j) / stages_ms(one));
    peers.push_back(stages_ms(j) / peer);
    nodes.push_back(j["averages"]["nodes_a_receiver"]);
    std::printf("%-28s %10d %9.1f %9.1f %7.2f %9.1f %7.2f %8.2f\n", scene.stem().c_str(),
                j["scene"]["triangles"].get<int>(), stages_ms(one), stages_ms(j), ratios.back(), peer, peers.back(),
                nodes.back());
  }
  const double nodes_px = std::accumulate(nodes.begin(), nodes.end(), 0.0) / double(nodes.size());
  std::printf("medians: 32 / 1 %.2f, / peer %.2f; mean nodes %.2f\n", median(ratios), median(peers), nodes_px);
  EXPECT_LE(median(ratios), 2.5);
  EXPECT_LE(median(peers), 2.0);
  EXPECT_LE(nodes_px, 2.2);
}

}  // namespace
}  // namespace izb::test
