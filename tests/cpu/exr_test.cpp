// SPDX-License-Identifier: MIT
#include "image/exr.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <bit>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <set>
#include <stdexcept>

#include "base/error.h"
#include "base/file.h"
#include "full_device.h"

namespace {

namespace fs = std::filesystem;
using izb::Image;

constexpr float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();

struct Exr : testing::Test {
  const fs::path folder = fs::path(testing::TempDir()) / ("izb_exr_test_" + std::to_string(getpid()));
  const fs::path path = folder / "a.exr";
  Exr() { fs::create_directories(folder); }
  ~Exr() override { fs::remove_all(folder); }

  std::set<std::string> names() const {
    std::set<std::string> found;
    for (const auto& entry : fs::directory_iterator(folder)) found.insert(entry.path().filename());
    return found;
  }
};

/// Every row and column differs, so that a flip or a wrong stride shows.
Image test_image(int width_px, int height_px) {
  Image image{width_px, height_px, {}, {}};
  for (const char* name : {"R", "G", "B", "depth"}) {
    std::vector<float>& values = image.add_float(name);
    for (size_t i = 0; i < values.size(); ++i) values[i] = 0.37f * float(i) + float(name[0]);
  }
  std::vector<uint32_t>& mask = image.add_uint("mask");
  for (size_t i = 0; i < mask.size(); ++i) mask[i] = 0xFFFFFFFFu - uint32_t(i) * 2654435761u;
  image.attributes["worldToCamera"] = std::array<float, 16>{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16};
  return image;
}

std::string error_of(const fs::path& path) {
  try {
    izb::read_exr(path);
  } catch (const izb::Error& error) {
    return error.what();
  }
  return {};
}

std::string output_of(const std::string& command) {
  std::string text;
  char bytes[4096];
  std::FILE* pipe = popen(command.c_str(), "r");
  while (pipe && std::fgets(bytes, sizeof bytes, pipe)) text += bytes;
  if (pipe) pclose(pipe);
  return text;
}

TEST_F(Exr, KeepsEveryBitOfEveryChannel) {
  Image image = test_image(67, 41);  // three blocks of rows, the last one incomplete
  auto& depth = std::get<std::vector<float>>(image.channels[3].data);
  depth[0] = nan, depth[1] = infinity, depth[2] = -infinity, depth[3] = -0.0f, depth[4] = 1e-40f;
  izb::write_exr(path, image);
  const Image back = izb::read_exr(path);

  EXPECT_EQ(back.width_px, 67);
  EXPECT_EQ(back.height_px, 41);
  ASSERT_EQ(back.channels.size(), 5u);
  EXPECT_EQ(back.uints("mask"), image.uints("mask"));
  for (const char* name : {"R", "G", "B", "depth"}) {
    const std::vector<float>&a = image.floats(name), &b = back.floats(name);
    ASSERT_EQ(a.size(), b.size());
    for (size_t i = 0; i < a.size(); ++i) {
      ASSERT_EQ(std::bit_cast<uint32_t>(a[i]), std::bit_cast<uint32_t>(b[i])) << name << " " << i;
    }
  }
  EXPECT_EQ(names(), std::set<std::string>{"a.exr"});
}

TEST_F(Exr, KeepsAttributes) {
  Image image = test_image(2, 1);
  image.attributes["izb.command"] = "izb render \"a b.gltf\"";
  image.attributes["izb.repeat"] = 7;
  image.attributes["izb.fov"] = 0.1;
  image.attributes["izb.exposure"] = 0.1f;
  image.attributes["izb.sun"] = std::array<float, 2>{30.0f, 45.0f};
  image.attributes["izb.light"] = std::array<float, 3>{1.0f, -2.0f, 0.5f};
  image.attributes["worldToNDC"] = std::array<float, 16>{0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 1, 0, 0, 0};
  izb::write_exr(path, image);
  EXPECT_EQ(izb::read_exr(path).attributes, image.attributes);
}

TEST_F(Exr, HalfColorIsRoundedAndClampedAndLeavesTheRest) {
  Image image = test_image(3, 1);
  image.channels[0].data = std::vector<float>{0.1f, 1e6f, nan};
  izb::write_exr(path, image, {.half_color = true});
  const Image back = izb::read_exr(path);
  EXPECT_EQ(back.floats("R")[0], 0.0999755859375f);
  EXPECT_EQ(back.floats("R")[1], 65504.0f);
  EXPECT_TRUE(std::isnan(back.floats("R")[2]));
  EXPECT_EQ(back.floats("depth"), image.floats("depth"));
  EXPECT_EQ(back.uints("mask"), image.uints("mask"));
}

TEST_F(Exr, AnotherReaderSeesChannelsMatrixAndPixels) {
  if (std::system("oiiotool --version > /dev/null 2>&1") != 0) GTEST_SKIP() << "no oiiotool";
  izb::write_exr(path, test_image(4, 3));
  const std::string info = output_of("oiiotool --info -v " + path.string() + " 2>&1");
  EXPECT_NE(info.find("4 x    3"), std::string::npos) << info;
  EXPECT_NE(info.find("R (float), G (float), B (float), depth (float), mask (uint)"), std::string::npos) << info;
  EXPECT_NE(info.find("worldToCamera: 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16"), std::string::npos)
      << info;

  // The third pixel of the first row: x right, y down.
  const std::string pixels = output_of("oiiotool --dumpdata " + path.string() + " 2>&1");
  EXPECT_NE(pixels.find("Pixel (2, 0): 82.739997"), std::string::npos) << pixels;
}

TEST_F(Exr, ReadingFailsInOneSentence) {
  EXPECT_EQ(error_of(path), "cannot read '" + path.string() + "': No such file or directory");
  const std::string prefix = "cannot read '" + path.string() + "' as OpenEXR: ";
  for (const std::string text : {"", "v", "this is not an image"}) {
    izb::write_file_atomically(path, text);
    const std::string message = error_of(path);
    EXPECT_EQ(message.substr(0, prefix.size()), prefix) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos);
    EXPECT_EQ(message.find(path.string(), prefix.size()), std::string::npos) << "names the file twice: " << message;
  }
}

TEST_F(Exr, EveryTruncationIsAnError) {
  izb::write_exr(path, test_image(33, 40));
  const std::string whole = izb::read_text_file(path);
  for (size_t size = 0; size < whole.size(); size += 1 + whole.size() / 97) {
    izb::write_file_atomically(path, whole.substr(0, size));
    EXPECT_NE(error_of(path), "") << size << " of " << whole.size() << " bytes";
  }
}

TEST_F(Exr, AFailedWriteLeavesTheOldFile) {
  izb::write_exr(path, test_image(4, 3));
  const std::string old = izb::read_text_file(path);
  Image bad = test_image(4, 3);
  bad.attributes["channels"] = "an attribute that OpenEXR reserves";
  EXPECT_THROW(izb::write_exr(path, bad), izb::Error);
  EXPECT_THROW(izb::write_exr(path, Image{}), izb::Error);
  EXPECT_EQ(izb::read_text_file(path), old);
  EXPECT_EQ(names(), std::set<std::string>{"a.exr"});
}

TEST_F(Exr, AFullDiskIsAnError) {
  const auto full = full_device(folder);
  if (!full) GTEST_SKIP() << "no full device";
  EXPECT_THROW(izb::write_exr(*full, test_image(4, 3)), izb::Error);
  EXPECT_THROW(izb::write_exr(*full, test_image(300, 200)), izb::Error);
}

TEST_F(Exr, APathBelowAFileIsAnError) {
  izb::write_exr(path, test_image(4, 3));
  EXPECT_THROW(izb::write_exr(path / "b.exr", test_image(4, 3)), izb::Error);
}

TEST(Image, FindsChannelsAndNamesMissingOnes) {
  Image image{2, 2, {}, {}};
  image.add("a", std::vector<float>{1, 2, 3, 4});
  EXPECT_NE(image.find("a"), nullptr);
  EXPECT_EQ(image.find("b"), nullptr);
  EXPECT_EQ(image.floats("a")[3], 4.0f);
  EXPECT_THROW(image.uints("a"), izb::Error);
  EXPECT_THROW(image.floats("b"), izb::Error);
  EXPECT_THROW(image.add("c", std::vector<uint32_t>(3)), std::logic_error);
}

}  // namespace
