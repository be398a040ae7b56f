// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <regex>

#include "cli/run_program.h"

namespace {

using namespace izb::test;

TEST(Help, NamesEveryCommand) {
  const Outcome outcome = izb::test::izb({"--help"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.err, "");
  for (const char* command : {"render", "validate", "compare", "info", "scene", "--version"})
    EXPECT_TRUE(outcome.prints(command)) << command;
}

TEST(Help, VersionAndCommit) {
  const Outcome outcome = izb::test::izb({"--version"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_TRUE(std::regex_match(outcome.out, std::regex("izb " IZB_VERSION " \\(([0-9a-f]{7,40}|unknown)\\)\n")))
      << outcome.out;
}

/// The lines of a command's help, each option with its explanation in one.
std::string help_of(std::vector<std::string> words) {
  words.push_back("--help");
  const Outcome outcome = izb::test::izb(words);
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  return std::regex_replace(outcome.out, std::regex("\n {10,}"), " ");
}

void expect_options(const std::string& help, const std::vector<std::string>& names) {
  for (const std::string& name : names)
    EXPECT_TRUE(std::regex_search(help, std::regex("\n *(-[a-z],)?" + name + " [^\n]{10,}"))) << name << "\n" << help;
}

const std::vector<std::string> frame_options{"--size",  "--camera",    "--eye",       "--target",
                                             "--fov",   "--light",     "--sun",       "--spot",
                                             "--views", "--viewpoint", "--technique", "--context"};

TEST(Help, RenderIsComplete) {
  const std::string help = help_of({"render"});
  expect_options(help, frame_options);
  expect_options(
      help, {"--output", "--preview", "--json", "--repeat", "--peer", "--grid", "--raster", "--zcull", "--nl-cull"});
  for (const char* text : {"default 1280x720", "degrees", "default 2048", "default on", "pixels", "world units"})
    EXPECT_NE(help.find(text), std::string::npos) << text << "\n" << help;
}

TEST(Help, ValidateIsComplete) {
  const std::string help = help_of({"validate"});
  expect_options(help, frame_options);
  expect_options(help, {"--json", "--heatmap", "--grid", "--zcull", "--nl-cull"});
}

TEST(Help, CompareIsComplete) {
  const std::string help = help_of({"compare"});
  expect_options(help, {"--truth",
                        "--json",
                        "--error-map",
                        "--channels",
                        "--exposure",
                        "--ppd",
                        "--max-flip",
                        "--max-rmse",
                        "--min-psnr",
                        "--min-ssim",
                        "--max-differing-bits",
                        "--max-leaks",
                        "--max-false-shadow",
                        "--max-coverage-error",
                        "--max-unexplained",
                        "--max-difference",
                        "--size",
                        "--camera",
                        "--eye",
                        "--light",
                        "--sun",
                        "--spp",
                        "--samples",
                        "--nl-cull",
                        "--context"});
  for (const char* text : {"67.0206", "pixels per degree", "stops", "percent", "Exit code 1"})
    EXPECT_NE(help.find(text), std::string::npos) << text << "\n" << help;
  EXPECT_EQ(help.find("--technique"), std::string::npos);
}

TEST(Help, InfoAndSceneAreComplete) {
  expect_options(help_of({"info"}), {"--context"});
  const std::string scene = help_of({"scene"});
  expect_options(scene, {"--output", "--seed", "--triangles"});
  for (const char* name : {"garden", "villa", "town", "terrain", "hairball", "tentacles", "plane", "powerplant",
                           "furball", "character", "grass", "12300000 triangles"})
    EXPECT_NE(scene.find(name), std::string::npos) << name;
}

TEST(Info, SaysWhereProgramsAreKept) {
  const auto program_cache = [](const std::string& place) {
    return izb::test::izb({"info"}, {{{"IZB_PROGRAM_CACHE", place}}, false}).out;
  };
  EXPECT_NE(program_cache("/some/where").find("/some/where"), std::string::npos);
  EXPECT_TRUE(std::regex_search(program_cache("off"), std::regex("program cache +off")));
}

TEST(Help, EachTechniqueListsItsOwnOptions) {
  EXPECT_NE(help_of({"render", "--technique", "izb"}).find("--zcull"), std::string::npos);
  const std::string traced = help_of({"render", "--technique", "ray_traced"});
  EXPECT_EQ(traced.find("--zcull"), std::string::npos);
  EXPECT_NE(traced.find("ray_traced"), std::string::npos);
  const std::string mapped = help_of({"render", "--technique", "shadow_map"});
  expect_options(mapped, {"--resolution", "--cascades", "--fit", "--split-lambda", "--distance", "--filter", "--radius",
                          "--bias", "--slope-bias", "--normal-offset", "--receiver-plane", "--nl-cull"});
  EXPECT_EQ(mapped.find("--zcull"), std::string::npos);
}

}  // namespace
