// SPDX-License-Identifier: MIT
#include "image/mask_metrics.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace {

using Mask = std::vector<uint32_t>;

TEST(MaskMetrics, SamplesAreTakenFromTheWords) {
  EXPECT_EQ(izb::samples_of(Mask{0, ~0u, 0}), 1);
  EXPECT_EQ(izb::samples_of(Mask{0, ~0u, 1}), 32);
}

TEST(MaskMetrics, CountsBits) {
  //                  equal  leak 4  false 1  both 1 + 2
  const Mask reference{~0u, 0xFFu, 0x0u, 0x1u}, test{~0u, 0x0Fu, 0x8u, 0x6u};
  const izb::MaskDifference d = izb::compare_masks(reference, test, 32);
  EXPECT_EQ(d.pixels, 4u);
  EXPECT_EQ(d.bits, 128u);
  EXPECT_EQ(d.shadowed, 32u + 8u + 0u + 1u);
  EXPECT_EQ(d.lit(), 128u - 41u);
  EXPECT_EQ(d.leaks, 4u + 1u);
  EXPECT_EQ(d.false_shadow, 1u + 2u);
  EXPECT_EQ(d.differing(), 8u);
  EXPECT_EQ(d.differing_pixels, 3u);
  EXPECT_DOUBLE_EQ(d.mean_coverage_error(), (4 + 1 + 1) / 32.0 / 4.0);
  EXPECT_DOUBLE_EQ(d.largest_coverage_error, 4 / 32.0);
  EXPECT_EQ(izb::coverage_error(0xFFu, 0x0Fu, 32), -4.0f / 32.0f);
}

TEST(MaskMetrics, OneSampleFillsTheWord) {
  const izb::MaskDifference d = izb::compare_masks(Mask{~0u, ~0u, 0, 0}, Mask{~0u, 0, ~0u, 1}, 1);
  EXPECT_EQ(d.bits, 4u);
  EXPECT_EQ(d.leaks, 1u);
  EXPECT_EQ(d.false_shadow, 2u);  // any word but 0 is shadow
  EXPECT_DOUBLE_EQ(d.mean_coverage_error(), 0.75);
}

TEST(MaskMetrics, OnlyWhatIsCountedCounts) {
  const std::vector<uint8_t> counted{1, 0, 0};
  const izb::MaskDifference d = izb::compare_masks(Mask{1, 2, 3}, Mask{1, 0, 0}, 32, counted);
  EXPECT_EQ(d.pixels, 1u);
  EXPECT_EQ(d.differing(), 0u);
  const izb::MaskDifference nothing = izb::compare_masks(Mask{1}, Mask{2}, 32, std::vector<uint8_t>{0});
  EXPECT_EQ(nothing.bits, 0u);
  EXPECT_EQ(nothing.mean_coverage_error(), 0.0);
}

TEST(MaskMetrics, ThePictureIsRedForLeaksAndBlueForFalseShadow) {
  const std::vector<uint8_t> counted{1, 1, 1, 0};
  const izb::Image8 picture = izb::mask_difference_picture(Mask{1, 0, 0, 0}, Mask{0, 1, 0, 1}, 32, counted, 4, 1);
  const auto px = [&](size_t x, size_t c) { return int(picture.pixels[3 * x + c]); };
  EXPECT_GT(px(0, 0), px(0, 2) + 50);
  EXPECT_GT(px(1, 2), px(1, 0) + 50);
  EXPECT_EQ(px(2, 0), px(2, 2));
  EXPECT_EQ(px(2, 0), px(2, 1));
  EXPECT_EQ(px(3, 0) + px(3, 1) + px(3, 2), 0);
}

TEST(MaskMetrics, WrongSizesAreBugs) {
  EXPECT_THROW(izb::compare_masks(Mask{1}, Mask{1, 2}, 32), std::logic_error);
  EXPECT_THROW(izb::compare_masks(Mask{1}, Mask{1}, 32, std::vector<uint8_t>{1, 1}), std::logic_error);
  EXPECT_THROW(izb::compare_masks(Mask{1}, Mask{1}, 4), std::logic_error);
}

}  // namespace
