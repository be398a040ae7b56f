// SPDX-License-Identifier: MIT
// `cmake --install` gives a program that runs from its own files.
#include <gtest/gtest.h>

#include "cli/run_program.h"
#include "cli/small_scenes.h"

namespace {

namespace fs = std::filesystem;
using namespace izb::test;

TEST(Install, TheInstalledProgramRunsFromItsOwnFiles) {
  const TemporaryFolder folder;
  const fs::path prefix = folder / "prefix";
  const Outcome installed = run_program({IZB_CMAKE, "--install", IZB_BUILD_DIR, "--prefix", prefix});
  ASSERT_EQ(installed.code, 0) << installed.err;
  const fs::path program = prefix / "bin" / "izb";
  EXPECT_EQ(run_program({program, "--version"}).out, izb::test::izb({"--version"}).out);
  for (const char* file :
       {"share/izb/glsl/frame/6_shade.comp.glsl", "share/izb/views.json", "share/izb/sweeps.json",
        "share/izb/paper.json", "share/izb/garden.glb", "share/izb/report/report.css", "share/izb/report/plots.js",
        "share/izb/report/d3_licence.txt", "share/doc/izb/LICENSE", "share/doc/izb/CITATION.cff"})
    EXPECT_TRUE(fs::is_regular_file(prefix / file)) << file;
  EXPECT_EQ(fs::is_regular_file(prefix / "share/izb/report/d3.min.js"), fs::is_regular_file(IZB_D3));

  const fs::path scene = write_file(folder / "roof.glb", roof_over_floor().glb());
  const std::vector<std::string> render{program, "render", scene, "-o", folder / "frame.exr", "--size", "32x18"};
  const RunOptions debug{{{"IZB_GL_DEBUG", "1"}}, false};
  const Outcome good = run_program(render, debug);
  EXPECT_EQ(good.code, 0) << good.err;
  EXPECT_FALSE(good.says("warning: GL:")) << good.err;
  // So are the sweeps of the research harness.
  const std::vector<std::string> list{"env", "-C", folder / "", program, "bench", "all", "--list"};
  const Outcome sweeps = run_program(list);
  EXPECT_EQ(sweeps.code, 0) << sweeps.err;
  EXPECT_EQ(sweeps.out, izb::test::izb({"bench", "all", "--list"}).out);
  std::ofstream(prefix / "share/izb/sweeps.json") << "planted mistake";
  EXPECT_TRUE(run_program(list).says("share/izb/sweeps.json' is not the JSON that it should be"));
  // A mistake in the installed shader shows that it is this one which runs, not the source tree's.
  std::ofstream(prefix / "share/izb/glsl/frame/6_shade.comp.glsl", std::ios::app) << "planted mistake\n";
  const Outcome planted = run_program(render, debug);
  EXPECT_EQ(planted.code, 1);
  EXPECT_TRUE(planted.says("6_shade.comp.glsl")) << planted.err;
}

}  // namespace
