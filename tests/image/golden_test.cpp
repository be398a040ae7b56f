// SPDX-License-Identifier: MIT
// Against drift: the shipped scene as it was when it was last looked at. With IZB_UPDATE_GOLDEN set, the files are
// written instead of compared: look at them before committing.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/run_program.h"
#include "cpu/gltf_writer.h"
#include "image/exr.h"

namespace izb::test {
namespace {

namespace fs = std::filesystem;

const fs::path golden_folder = IZB_SOURCE_DIR "/tests/image/golden";

class Golden : public testing::TestWithParam<std::tuple<const char*, const char*>> {};

TEST_P(Golden, TheShippedSceneLooksAsItDid) {
  const std::string camera = std::get<0>(GetParam()), spp = std::get<1>(GetParam());
  const TemporaryFolder folder;
  const fs::path scene = folder / "garden.glb", exr = folder / "out.exr", json = folder / "out.json";
  ASSERT_EQ(izb({"scene", "garden", "-o", scene}).code, 0);
  const Outcome outcome =
      izb({"render", scene, "--camera", camera, "--spp", spp, "--size", "240x135", "-o", exr, "--json", json});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const std::string renderer = nlohmann::json::parse(std::ifstream(json))["gl"]["renderer"];
  if (renderer.find("llvmpipe") == std::string::npos)
    GTEST_SKIP() << "the files come from llvmpipe; other rasterisers cover other pixels: " << renderer;
  const fs::path golden = golden_folder / ("garden_" + camera + "_" + spp + ".exr");
  if (std::getenv("IZB_UPDATE_GOLDEN")) {
    Image small = read_exr(exr);
    small.attributes.clear();
    std::erase_if(small.channels,
                  [](const Channel& c) { return c.name != "R" && c.name != "G" && c.name != "B" && c.name != "mask"; });
    write_exr(golden, small, {.half_color = true});
    GTEST_SKIP() << "wrote " << golden;
  }
  const Image now = read_exr(exr), then = read_exr(golden);
  ASSERT_EQ(now.width_px, then.width_px);
  EXPECT_EQ(now.uints("mask"), then.uints("mask"));
  // 16-bit files: half an ulp of a half below 2 is 2^-12; the rest is the driver's own rounding of powers and roots.
  for (const char* channel : {"R", "G", "B"}) {
    double largest = 0.0;
    for (size_t i = 0; i < now.pixel_count(); ++i)
      largest = std::max(largest, std::abs(double(now.floats(channel)[i]) - double(then.floats(channel)[i])));
    EXPECT_LT(largest, 0.004) << channel;
  }
}

INSTANTIATE_TEST_SUITE_P(Cameras, Golden,
                         testing::Combine(testing::Values("main", "wires", "grass", "contact"),
                                          testing::Values("1", "32")));

}  // namespace
}  // namespace izb::test
