// SPDX-License-Identifier: MIT
#include "image/png.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include "base/error.h"
#include "base/file.h"
#include "full_device.h"

namespace {

namespace fs = std::filesystem;
using izb::Image8;

struct Png : testing::Test {
  const fs::path folder = fs::path(testing::TempDir()) / ("izb_png_test_" + std::to_string(getpid()));
  const fs::path path = folder / "a.png";
  Png() { fs::create_directories(folder); }
  ~Png() override { fs::remove_all(folder); }
};

Image8 test_picture(int width_px, int height_px, int components) {
  Image8 picture{width_px, height_px, components, {}};
  for (int i = 0; i < width_px * height_px * components; ++i) picture.pixels.push_back(uint8_t(i * 37 + i / 256));
  return picture;
}

std::string error_of(const fs::path& path) {
  try {
    izb::read_png(path);
  } catch (const izb::Error& error) {
    return error.what();
  }
  return {};
}

TEST_F(Png, KeepsEveryPixel) {
  for (const int components : {3, 4}) {
    const Image8 picture = test_picture(35, 17, components);
    izb::write_png(path, picture);
    const Image8 back = izb::read_png(path);
    EXPECT_EQ(back.width_px, 35);
    EXPECT_EQ(back.height_px, 17);
    EXPECT_EQ(back.components, components);
    EXPECT_EQ(back.pixels, picture.pixels);
  }
}

TEST_F(Png, ReadingFailsInOneSentence) {
  EXPECT_EQ(error_of(path), "cannot read '" + path.string() + "': No such file or directory");
  const std::string prefix = "cannot read '" + path.string() + "' as PNG: ";
  for (const std::string text : {"", "P", "this is not an image"}) {
    izb::write_file_atomically(path, text);
    EXPECT_EQ(error_of(path).substr(0, prefix.size()), prefix) << error_of(path);
  }
}

TEST_F(Png, EveryTruncationThatLosesPixelsIsAnError) {
  izb::write_png(path, test_picture(40, 40, 3));
  const std::string whole = izb::read_text_file(path);
  // The last 12 bytes are the end marker, without which nothing is missing.
  for (size_t size = 0; size + 24 < whole.size(); size += 61) {
    izb::write_file_atomically(path, whole.substr(0, size));
    EXPECT_NE(error_of(path), "") << size << " of " << whole.size() << " bytes";
  }
}

TEST_F(Png, AFailedWriteLeavesTheOldFile) {
  izb::write_png(path, test_picture(4, 3, 3));
  const std::string old = izb::read_text_file(path);
  EXPECT_THROW(izb::write_png(path, Image8{}), izb::Error);
  EXPECT_EQ(izb::read_text_file(path), old);
  EXPECT_THROW(izb::write_png(path / "b.png", test_picture(4, 3, 3)), izb::Error);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 1);
}

TEST_F(Png, AFullDiskIsAnError) {
  const auto full = full_device(folder);
  if (!full) GTEST_SKIP() << "no full device";
  EXPECT_THROW(izb::write_png(*full, test_picture(4, 3, 3)), izb::Error);
}

}  // namespace
