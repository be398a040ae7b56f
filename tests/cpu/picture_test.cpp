// SPDX-License-Identifier: MIT
#include "image/picture.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "image/srgb.h"

namespace {

using izb::Image;
using izb::Image8;

/// Values 0, 1, 2, ... in R, twice that in the integers of `mask`.
Image numbered(int width_px, int height_px) {
  Image image;
  image.width_px = width_px, image.height_px = height_px;
  std::vector<float>& red = image.add_float("R");
  for (size_t i = 0; i < red.size(); ++i) red[i] = float(i);
  std::vector<uint32_t>& mask = image.add_uint("mask");
  for (size_t i = 0; i < mask.size(); ++i) mask[i] = uint32_t(2 * i);
  image.attributes["whole"] = 1;
  return image;
}

TEST(Picture, ACropHasItsPixelsInAllChannels) {
  const Image part = crop(numbered(5, 4), {2, 1, 3, 2});
  EXPECT_EQ(part.width_px, 3);
  EXPECT_EQ(part.height_px, 2);
  EXPECT_EQ(part.floats("R"), (std::vector<float>{7, 8, 9, 12, 13, 14}));
  EXPECT_EQ(part.uints("mask"), (std::vector<uint32_t>{14, 16, 18, 24, 26, 28}));
  EXPECT_TRUE(part.attributes.empty());
}

TEST(Picture, ACropOutsideIsABug) {
  const Image image = numbered(5, 4);
  EXPECT_NO_THROW(crop(image, {0, 0, 5, 4}));
  for (const izb::PixelRect& part :
       {izb::PixelRect{-1, 0, 2, 2}, {0, -1, 2, 2}, {4, 0, 2, 2}, {0, 3, 2, 2}, {0, 0, 0, 2}, {0, 0, 2, 0}})
    EXPECT_THROW(crop(image, part), std::logic_error);
}

TEST(Picture, TheBoxFilterTakesMeansOfWholeBlocks) {
  const Image small = box_filter(numbered(4, 6), 2);
  EXPECT_EQ(small.width_px, 2);
  EXPECT_EQ(small.height_px, 3);
  EXPECT_EQ(small.floats("R"), (std::vector<float>{2.5f, 4.5f, 10.5f, 12.5f, 18.5f, 20.5f}));
  EXPECT_EQ(small.find("mask"), nullptr) << "bits have no mean";
  EXPECT_THROW(box_filter(numbered(4, 6), 3), std::logic_error);
  EXPECT_THROW(box_filter(numbered(4, 6), 0), std::logic_error);
}

TEST(Picture, CroppingAndFilteringCommute) {
  const Image image = numbered(8, 8);
  EXPECT_EQ(box_filter(crop(image, {2, 4, 4, 2}), 2).floats("R"), crop(box_filter(image, 2), {1, 2, 2, 1}).floats("R"));
}

TEST(Picture, ThePreviewIsSrgb) {
  Image image = numbered(2, 1);
  image.add("G", std::vector{0.5f, -1.0f});
  image.add("B", std::vector{0.25f, 7.0f});
  const Image8 picture = preview(image);
  EXPECT_EQ(picture.pixels, (std::vector<uint8_t>{0, izb::to_srgb8(0.5f), izb::to_srgb8(0.25f), 255, 0, 255}));
}

TEST(Picture, MagnifyRepeatsPixels) {
  const Image8 one{2, 1, 3, {1, 2, 3, 4, 5, 6}};
  const Image8 two = magnify(one, 2);
  EXPECT_EQ(two.width_px, 4);
  EXPECT_EQ(two.height_px, 2);
  const std::vector<uint8_t> row{1, 2, 3, 1, 2, 3, 4, 5, 6, 4, 5, 6};
  EXPECT_TRUE(std::equal(row.begin(), row.end(), two.pixels.begin()));
  EXPECT_TRUE(std::equal(row.begin(), row.end(), two.pixels.begin() + 12));
  EXPECT_EQ(magnify(Image8{1, 1, 4, {1, 2, 3, 4}}, 2).pixels.size(), 16u);
  EXPECT_THROW(magnify(one, 0), std::logic_error);
}

TEST(Picture, SideBySideKeepsOrderAndGap) {
  const Image8 a{1, 2, 3, {1, 1, 1, 2, 2, 2}}, b{2, 2, 3, {3, 3, 3, 4, 4, 4, 5, 5, 5, 6, 6, 6}};
  const Image8 both = izb::side_by_side(std::vector{a, b}, 1, {9, 8, 7});
  EXPECT_EQ(both.width_px, 4);
  EXPECT_EQ(both.height_px, 2);
  EXPECT_EQ(both.pixels,
            (std::vector<uint8_t>{1, 1, 1, 9, 8, 7, 3, 3, 3, 4, 4, 4, 2, 2, 2, 9, 8, 7, 5, 5, 5, 6, 6, 6}));
  EXPECT_EQ(izb::side_by_side(std::vector{a}, 1, {0, 0, 0}).pixels, a.pixels);
  const Image8 low{1, 1, 3, {1, 1, 1}};
  EXPECT_THROW(izb::side_by_side(std::vector{a, low}, 1, {0, 0, 0}), std::logic_error);
  EXPECT_THROW(izb::side_by_side({}, 1, {0, 0, 0}), std::logic_error);
}

}  // namespace
