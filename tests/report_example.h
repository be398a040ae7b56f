// SPDX-License-Identifier: MIT
// A document of a report with everything that one may hold. Its "measured" numbers are made up by formulas: it is for
// the page's tests, and to look at.
#pragma once
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "image/heat_map.h"
#include "image/png.h"

namespace izb::test {

using nlohmann::json;

/// As a stranger would name a file.
inline const char* const hostile_name = "</script><b onclick='x'>\"é\" & `ü`.glb";

inline double rounded(double value, double step) {
  return std::round(value / step) * step;
}

inline json example_plot(const char* id, const char* title, const char* kind, const json& x, const json& y,
                         const json& series) {
  return {{"id", id}, {"title", title}, {"kind", kind}, {"x", x}, {"y", y}, {"series", series}};
}

/// Table 1 of the paper for some of its scenes, 32 samples, beside made-up times of ours.
inline json example_stages() {
  struct Scene {
    const char* name;
    double triangles;
    std::vector<double> paper_ms;  // G-Buf, bounds, create IZB, z-cull setup, raster tris, final render
  };
  const Scene scenes[] = {{"Chalmers Villa", 89e3, {0.7, 0.8, 1.7, 1.1, 2.9, 0.3}},
                          {"Bungie Building", 255e3, {1.2, 0.8, 1.7, 1.1, 7.5, 0.4}},
                          {"Epic Citadel", 374e3, {1.0, 0.7, 1.6, 1.1, 7.3, 0.3}},
                          {"Bungie Terrain", 1.5e6, {1.9, 0.8, 1.9, 1.1, 19.5, 0.4}},
                          {"Hairball", 2.9e6, {2.6, 0.7, 1.9, 1.1, 51.7, 0.3}},
                          {"UNC Powerplant", 12.3e6, {3.8, 0.8, 2.1, 1.1, 67.4, 0.4}}};
  const std::vector<std::string> stages{"gbuffer", "bounds", "build", "zcull", "visibility", "shade"};
  json columns{{{"name", "scene"}, {"align", "left"}}, {{"name", "triangles"}, {"digits", 0}}};
  for (const std::string& stage : stages)
    for (const char* source : {"measured", "paper"})
      columns.push_back({{"name", source[0] == 'm' ? "izb" : "paper"},
                         {"unit", "ms"},
                         {"digits", 1},
                         {"source", source},
                         {"group", stage}});
  json rows = json::array(), series = json::array(), names = json::array();
  for (const std::string& stage : stages)
    for (const char* source : {"measured", "paper"})
      series.push_back({{"name", stage}, {"source", source}, {"values", json::array()}});
  for (const Scene& scene : scenes) {
    json row{scene.name, scene.triangles};
    names.push_back(scene.name);
    for (size_t i = 0; i < stages.size(); ++i) {
      const double ours_ms = rounded(scene.paper_ms[i] * (0.7 + 0.13 * double(i)) + 0.02 * double(i * i), 0.001);
      row.push_back(ours_ms);
      row.push_back(scene.paper_ms[i]);
      series[2 * i]["values"].push_back(ours_ms);
      series[2 * i + 1]["values"].push_back(scene.paper_ms[i]);
    }
    rows.push_back(row);
  }
  rows[4][10] = {{"reason", "timed out after 300 s"}};
  rows[5][10] = {{"reason", "timed out after 300 s"}};
  rows[2][3] = {{"value", 1.0}, {"note", "read off a figure"}};
  rows[0][6] = nullptr;
  series[8]["values"][4] = nullptr;
  series[8]["values"][5] = nullptr;
  json plot = example_plot("stages", "Stages of a frame", "stacked",
                           {{"label", "scene"}, {"scale", "category"}, {"values", names}},
                           {{"label", "time"}, {"unit", "ms"}, {"digits", 1}}, series);
  plot["caption"] = "Medians of 5 frames.";
  return {
      {"id", "table1"},
      {"title", "Table 1: time of each stage"},
      {"text",
       {"The stages of `izb render --preset paper` beside those of the paper's Table 1, 32 samples a pixel, 1920 × "
        "1080.",
        "Where a scene of the paper is not to be had, one of ours of the same size and kind stands for it."}},
      {"facts", json::array({{"options", "`--preset paper --spp 32 --cascades 4 --grid 2048`"},
                             {"shortened", "5 frames instead of 20"}})},
      {"notes",
       {"The paper's times are of a GeForce GTX 980.", "`zcull` includes the pyramid, which the paper does not have."}},
      {"software", true},
      {"tables",
       {{{"id", "table1"},
         {"caption", "Time of each stage, 32 samples a pixel"},
         {"empty", "this technique has no such stage"},
         {"columns", columns},
         {"rows", rows},
         {"summary", {{"median", 937e3, 1.1, 1.55, 0.6, 0.8, 1.7, 1.8, 1.2, 1.1, 16.4, 13.5, 0.5, 0.35}}}}}},
      {"plots", json::array({plot})}};
}

/// Lines over a light grid's side and over frames, with bands, gaps and log axes.
inline json example_lines() {
  json grids = json::array(), izb1, izb32, paper32, low, high, leaks;
  for (int grid = 256; grid <= 8192; grid *= 2) {
    const double x = std::log2(grid / 2048.0), time_ms = 240.0 + 60.0 * x * x + 10.0 * x;
    grids.push_back(grid);
    izb1.push_back(rounded(time_ms * 0.4, 0.01));
    izb32.push_back(rounded(time_ms, 0.01));
    low.push_back(rounded(time_ms * 0.93, 0.01));
    high.push_back(rounded(time_ms * 1.1, 0.01));
    paper32.push_back(grid == 512 || grid == 8192 ? json() : json(rounded(90.0 + 20.0 * x * x, 0.1)));
    leaks.push_back(rounded(std::pow(10.0, -1.2 * x), 1e-4));
  }
  json frames = json::array(), time_ms = json::array(), other_ms = json::array();
  for (int frame = 0; frame < 240; ++frame) {
    frames.push_back(frame);
    const bool lost = frame > 150 && frame < 163;
    time_ms.push_back(lost ? json()
                           : json(rounded(30.0 + 8.0 * std::sin(frame / 17.0) + 2.0 * std::sin(frame * 1.7), 0.01)));
    other_ms.push_back(frame == 156 || !lost ? json(rounded(22.0 + 3.0 * std::cos(frame / 30.0), 0.01)) : json());
  }
  const json grid_axis{{"label", "light grid"}, {"unit", "texels"}, {"scale", "log"}, {"values", grids}};
  const json scenes{"0ad_obedska_bog",
                    "flightgear_hawaii_terrain",
                    "kicad_video_board",
                    "ldraw_atst_ucs",
                    "ldraw_xwing",
                    "morse_human_rig",
                    "tressfx_mohawk_hair_long_variant_of_2014"};
  const json time_axis{{"label", "time"}, {"unit", "ms"}};
  const json of_32{{"name", "32 samples"}, {"values", izb32}, {"low", low}, {"high", high}};
  const json of_1{{"name", "1 sample"}, {"values", izb1}};
  const json of_paper{{"name", "32 samples, paper"}, {"source", "paper"}, {"values", paper32}};
  return {{"id", "grids"},
          {"title", "Light grids and animation"},
          {"software", true},
          {"text", json::array({"The side of the light-space grid changes the cost; bands span the fastest and the "
                                "slowest of five frames."})},
          {"plots",
           {example_plot("grid-time", "Time by resolution of the light grid", "line", grid_axis, time_axis,
                         {of_32, of_1, of_paper}),
            example_plot("grid-leaks", "Leaking samples by resolution of the light grid", "line", grid_axis,
                         {{"label", "leaks"}, {"unit", "per million samples"}, {"scale", "log"}},
                         json::array({{{"name", "approximate insertion"}, {"values", leaks}}})),
            example_plot("frames", "Time of each frame of an animation", "line",
                         {{"label", "frame"}, {"values", frames}}, time_axis,
                         {{{"name", "izb"}, {"values", time_ms}}, {{"name", "ray_traced"}, {"values", other_ms}}}),
            example_plot("by-scene", "Tests a pixel by scene", "line", {{"scale", "category"}, {"values", scenes}},
                         {{"label", "tests"}, {"unit", "a pixel"}},
                         json::array({{{"name", "izb"}, {"values", {3.1, 4.2, 2.0, 6.5, nullptr, 7.7, 12.1}}}}))}}};
}

/// Seventeen bars with values of both signs and their spread, and bars of two sources on a log axis.
inline json example_bars() {
  const std::vector<std::string> options{"--zcull off",
                                         "--zcull-pyramid off",
                                         "--nl-cull off",
                                         "--removal off",
                                         "--unchanged-skip off",
                                         "--pipelining on",
                                         "--dilation 0.5",
                                         "--nodes 2",
                                         "--nodes 8",
                                         "--cascades 1",
                                         "--cascades 4",
                                         "--cascades 4 --cascade-pass multiple",
                                         "--grid-density 0",
                                         "--coverage exact",
                                         "--insertion exact",
                                         "--alpha fragment",
                                         "--raster hw"};
  json change, low, high, fragments;
  for (size_t i = 0; i < options.size(); ++i) {
    const double value = 40.0 * std::sin(double(i * i)) + (i == 0 ? 190.0 : 12.0);
    change.push_back(rounded(value, 0.1));
    low.push_back(rounded(value - 3.0 - double(i % 3), 0.1));
    high.push_back(rounded(value + 4.0 + double(i % 4), 0.1));
    fragments.push_back(i == 5 ? json() : json(rounded(25.0 * std::cos(double(i)), 0.1)));
  }
  const json of_time{{"name", "time"}, {"values", change}, {"low", low}, {"high", high}};
  const json of_fragments{{"name", "fragments"}, {"values", fragments}};
  const json ours{{"name", "32 samples"}, {"values", {610.2, 1204.5, 31.7, nullptr}}};
  const json paper{{"name", "32 samples, paper"}, {"source", "paper"}, {"values", {12.0, 46.3, nullptr, 39.1}}};
  return {
      {"id", "ablation"},
      {"title", "Ablation: each option alone"},
      {"software", true},
      {"plots",
       {example_plot("ablation", "Change of the time of the shadow stages against the defaults", "bars",
                     {{"label", "option"}, {"scale", "category"}, {"values", options}},
                     {{"label", "change"}, {"unit", "%"}, {"digits", 1}}, {of_time, of_fragments}),
        example_plot("techniques", "Techniques on the garden", "bars",
                     {{"scale", "category"}, {"values", {"izb", "ray_traced", "shadow_map", "Sintorn et al. 2014"}}},
                     {{"label", "time"}, {"unit", "ms"}, {"scale", "log"}}, {ours, paper})}}};
}

/// Forty rows, which a head that stays in sight is for, and images.
inline json example_scenes(const std::filesystem::path& folder) {
  json rows = json::array();
  for (int i = 0; i < 40; ++i)
    rows.push_back({i == 7
                        ? hostile_name
                        : "scene_" + std::to_string(i * 7 % 40) + (i % 5 == 0 ? "_with_a_long_name_of_2048_parts" : ""),
                    (i * 7919) % 5000 * 613, rounded(std::exp(0.17 * ((i * 11) % 40)), 0.001),
                    rounded(40.0 / (i + 1.0), 0.0001), i % 3 - 1});
  rows[3][2] = {{"reason", "the driver was reset: `GL_CONTEXT_LOST`"}};
  std::filesystem::create_directories(folder / "images");
  const int width_px = 96, height_px = 54;
  json files = json::array();
  for (int k = 0; k < 3; ++k) {
    std::vector<float> values;
    for (int y = 0; y < height_px; ++y)
      for (int x = 0; x < width_px; ++x)
        values.push_back(
            0.5f + 0.5f * std::sin(0.02f * float(k + 1) * float((x - 48) * (x - 48) + (y - 27) * (y - 27)) / 6.0f));
    const std::string file = "images/heat_" + std::to_string(k) + ".png";
    write_png(folder / file, heat_map(values, width_px, height_px, 1.0f));
    files.push_back({{"file", file}, {"label", k == 0 ? "izb, 32 samples" : k == 1 ? "ray_traced" : "difference"}});
  }
  return {{"id", "scenes"},
          {"title", "All scenes"},
          {"software", false},
          {"facts", json::array({{"machine", "another one, with a GPU"}})},
          {"tables",
           {{{"id", "scenes"},
             {"caption", "Forty scenes"},
             {"columns",
              {{{"name", "scene"}, {"align", "left"}},
               {{"name", "triangles"}},
               {{"name", "visibility"}, {"unit", "ms"}, {"digits", 2}, {"source", "measured"}},
               {{"name", "leaks"}, {"unit", "%"}, {"digits", 4}},
               {{"name", "sign"}}}},
             {"rows", rows}}}},
          {"images",
           {{{"title", "Length of the lists"},
             {"caption", "Dark: 0, pale: 32 nodes. `--heatmap`"},
             {"files", files},
             {"pixelated", true}}}}};
}

/// Writes the images below `folder`.
inline json report_example(const std::filesystem::path& folder) {
  return {
      {"title", "Frustum-Traced Raster Shadows, measured again"},
      {"subtitle", "An example with everything that a report may hold; its numbers are made up."},
      {"facts",
       json::array({{"machine", "2 × AMD EPYC 9654 (2 cores used), 128 GB"},
                    {"driver", "llvmpipe (LLVM 15.0.6, 256 bits), Mesa 22.3.6"},
                    {"commit", "`fd19b17`"},
                    {"command", "`izb bench --paper --scenes $IZB_SCENES --repeat 5 --timeout 300 -o out/report.html`"},
                    {"measured", "2026-01-31 12:00 UTC"}})},
      {"software", true},
      {"sections", {example_stages(), example_lines(), example_bars(), example_scenes(folder)}}};
}

}  // namespace izb::test
