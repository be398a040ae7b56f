// SPDX-License-Identifier: MIT
// The bars of one sample a pixel at their stated sizes on real scenes. Prints its numbers; the small tests check the
// same in minutes.
#include "full/bars.h"

namespace izb::test {
namespace {

TEST_F(Bars, NothingUnexplained) {
  std::printf("%-8s %-28s %9s %9s %9s %9s %11s\n", "context", "scene", "compared", "shadowed", "disputed", "explained",
              "unexplained");
  for (const fs::path& scene : scenes)
    for (const char* context : {"egl", "osmesa"}) {
      const nlohmann::json j = run("validate", scene, {"--spp", "1", "--context", context});
      if (j.is_null()) continue;
      const double compared = j["compared"], disputed = j["disputed"];
      std::printf("%-8s %-28s %9.0f %9d %9.0f %9d %11d\n", context, scene.stem().c_str(), compared,
                  j["shadowed"].get<int>(), disputed, j["explained"].get<int>(), j["unexplained"].get<int>());
      EXPECT_EQ(j["unexplained"], 0) << scene;
      EXPECT_LE(disputed, 1e-4 * compared) << scene;
      EXPECT_EQ(j["points"]["wrong"], 0) << scene;
      EXPECT_LT(j["points"]["max_plane_ulps"].get<double>(), 4.0) << scene;
      EXPECT_LT(j["points"]["max_lift_px"].get<double>(), 0.501) << scene;
    }
}

TEST_F(Bars, SameMask) {
  expect_same_mask({"--spp", "1"}, {{{"--context", "osmesa"}, {}},
                                    {{"--grid", "256"}, {}},
                                    {{"--grid", "512"}, {}},
                                    {{"--grid", "1024"}, {}},
                                    {{"--grid", "4096"}, {}},
                                    {{"--zcull", "off"}, {}},
                                    {{}, {{{"LP_NUM_THREADS", "0"}}, false}},
                                    {{}, {{{"LP_NUM_THREADS", "1"}}, false}},
                                    {{}, {{{"LP_NUM_THREADS", "2"}}, false}}});
}

TEST_F(Bars, ZCullSaves) {
  std::vector<double> saved;
  std::printf("%-28s %12s %12s %7s\n", "scene", "fragments", "after z-cull", "saved");
  for (const fs::path& scene : scenes) {
    const nlohmann::json j = run("render", scene, {"--spp", "1"});
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
    const nlohmann::json j = run("render", scene, {"--spp", "1", "--repeat", "5", "--peer", "on"});
    if (j.is_null()) continue;
    const double sum = stages_ms(j, true), shadow = stages_ms(j);
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
}  // namespace izb::test
