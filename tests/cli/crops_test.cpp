// SPDX-License-Identifier: MIT
// bench/crops.sh, bench/figure_1.sh and their program, without the frames of the shipped scene: they take a minute.
#include <gtest/gtest.h>

#include "cli/run_program.h"
#include "cli/small_scenes.h"
#include "image/exr.h"
#include "image/png.h"

namespace izb::test {
namespace {

/// A frame of `side` x `side` pixels whose left half is lit, with one word for all of its mask.
void write_frame(const std::filesystem::path& path, int side, uint32_t mask) {
  Image frame;
  frame.width_px = frame.height_px = side;
  for (const char* name : {"R", "G", "B"}) {
    std::vector<float>& plane = frame.add_float(name);
    for (size_t i = 0; i < plane.size(); ++i) plane[i] = int(i) % side < side / 2 ? 1.0f : 0.0f;
  }
  frame.add("mask", std::vector<uint32_t>(frame.pixel_count(), mask));
  write_exr(path, frame);
}

TEST(Crops, PutsTheSamePixelsSideBySideAndCountsBits) {
  const TemporaryFolder folder;
  write_frame(folder / "a.exr", 4, 1);
  write_frame(folder / "b.exr", 4, 6);
  write_frame(folder / "large.exr", 8, 0);
  const Outcome outcome = run_program({IZB_CROPS, folder / "a.exr", folder / "b.exr", folder / "large.exr", "--crop",
                                       "1,2,2,1", "--magnify", "2", "-o", folder / "out.png"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(outcome.prints("6 of 64 mask bits of the crop differ, the shadow of a pixel by 3.12 %")) << outcome.out;
  const Image8 picture = read_png(folder / "out.png");
  EXPECT_EQ(picture.width_px, 3 * 4 + 2 * 4);
  EXPECT_EQ(picture.height_px, 2);
  for (const int panel : {0, 8, 16}) {
    EXPECT_EQ(picture.pixels[3 * size_t(panel)], 255) << panel;
    EXPECT_EQ(picture.pixels[3 * size_t(panel + 2)], 0) << panel;
  }
}

TEST(Crops, RefusesWhatItCannotShow) {
  const TemporaryFolder folder;
  write_frame(folder / "a.exr", 4, 1);
  write_frame(folder / "b.exr", 6, 1);
  const std::string out = folder / "out.png";
  const std::vector<std::string> program{IZB_CROPS, folder / "a.exr"};
  const auto code = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words = program;
    words.insert(words.end(), more.begin(), more.end());
    const Outcome outcome = run_program(words);
    EXPECT_FALSE(outcome.err.empty());
    return outcome.code;
  };
  EXPECT_EQ(code({"-o", out}), 2);
  EXPECT_EQ(code({"-o", out, "--crop", "1,1,1"}), 2);
  EXPECT_EQ(code({"-o", out, "--crop", "1,1,0,1"}), 2);
  EXPECT_EQ(code({"-o", out, "--crop", "1,1,1,1", "--magnify", "0"}), 2);
  EXPECT_EQ(code({"-o", out, "--crop", "1,1,4,1"}), 1);
  EXPECT_EQ(code({folder / "b.exr", "-o", out, "--crop", "1,1,1,1"}), 1);
  EXPECT_EQ(code({folder / "missing.exr", "-o", out, "--crop", "1,1,1,1"}), 1);
  EXPECT_EQ(names_in(folder / ""), (std::vector<std::string>{"a.exr", "b.exr"}));
}

TEST(Crops, TheScriptsSayHowTheyAreUsed) {
  for (const std::string name : {"crops", "figure_1"}) {
    const std::string script = IZB_SOURCE_DIR "/bench/" + name + ".sh";
    const Outcome help = run_program({script, "--help"});
    EXPECT_EQ(help.code, 0);
    EXPECT_TRUE(help.prints("usage: bench/" + name + ".sh")) << help.out;
    EXPECT_EQ(run_program({script, "--unknown"}).code, 2);
    EXPECT_EQ(run_program({script, "a.png", "b.png"}).code, 2);
    EXPECT_EQ(run_program({script, "/nonexistent/folder/a.png"}).code, 1);
  }
  EXPECT_EQ(run_program({IZB_SOURCE_DIR "/bench/figure_1.sh", "a.png", "4"}).code, 2);
}

}  // namespace
}  // namespace izb::test
