// SPDX-License-Identifier: MIT
#include "image/metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "cpu/metric_pairs.h"

namespace {

using namespace izb::test;

TEST(Metrics, AreThoseOfOtherProgramsOnKnownPairs) {
  // Nine decimals are known, but our code values are in single precision: 6.9e-9 in the RMSE of the pair hue and 1.1e-8
  // in the SSIM of the pair noise, which exact codes take away.
  constexpr double rounded_codes = 2e-8;
  for (const KnownPair& pair : known_pairs()) {
    const double error = izb::rmse(pair.reference, pair.test);
    EXPECT_NEAR(error, pair.expected["rmse"], rounded_codes) << pair.name;
    if (pair.expected["psnr_db"].is_null())
      EXPECT_EQ(izb::psnr_db(error), std::numeric_limits<double>::infinity()) << pair.name;
    else
      EXPECT_NEAR(izb::psnr_db(error), pair.expected["psnr_db"], 1e-6) << pair.name;
    EXPECT_NEAR(izb::ssim(pair.reference, pair.test).value(), pair.expected["ssim"], rounded_codes) << pair.name;
  }
}

TEST(Metrics, PsnrOfTheLargestErrorIsZeroWithoutASign) {
  EXPECT_EQ(izb::psnr_db(1.0), 0.0);
  EXPECT_FALSE(std::signbit(izb::psnr_db(1.0)));
}

TEST(Metrics, SsimNeedsAWindow) {
  EXPECT_FALSE(izb::ssim(plain(10, 40, 0, 0, 0), plain(10, 40, 0, 0, 0)).has_value());
  EXPECT_FALSE(izb::ssim(plain(40, 10, 0, 0, 0), plain(40, 10, 0, 0, 0)).has_value());
  EXPECT_NEAR(izb::ssim(plain(11, 11, 0, 0, 0), plain(11, 11, 0, 0, 0)).value(), 1.0, 1e-12);
}

TEST(Metrics, ValuesHaveMeanAndLargestDifference) {
  const std::vector<float> a{1, 2, 3, 4}, b{1, 2, 6, 0};
  const izb::ValueDifference d = izb::compare_values(a, b);
  EXPECT_DOUBLE_EQ(d.rmse, std::sqrt(25.0 / 4.0));
  EXPECT_DOUBLE_EQ(d.mean_abs, 7.0 / 4.0);
  EXPECT_DOUBLE_EQ(d.largest, 4.0);
  EXPECT_EQ(d.largest_at, 3u);
  EXPECT_THROW(izb::compare_values(a, std::vector<float>{1}), std::logic_error);
}

TEST(Metrics, TheWeightedMedianHalvesTheSum) {
  EXPECT_EQ(izb::pool(std::vector<float>{0, 0, 0, 0}).weighted_median, 0.0);
  // 1 + 1 + 2 is half of 8.
  const izb::Pooled pooled = izb::pool(std::vector<float>{4, 1, 2, 1, 0});
  EXPECT_DOUBLE_EQ(pooled.weighted_median, 2.0);
  EXPECT_DOUBLE_EQ(pooled.mean, 1.6);
  EXPECT_DOUBLE_EQ(pooled.max, 4.0);
  EXPECT_THROW(izb::pool({}), std::logic_error);
}

TEST(Metrics, LinearLightIsExposedClampedAndEncoded) {
  izb::StoredImage stored;
  stored.image.width_px = 3, stored.image.height_px = 1;
  for (const char* name : {"R", "G", "B"}) stored.image.add(name, std::vector<float>{-1.0f, 0.25f, 7.0f});
  EXPECT_EQ(izb::to_display(stored).rgb[1][0], 0.0f);
  EXPECT_NEAR(izb::to_display(stored).rgb[1][1], 0.537099f, 1e-6);  // 1.055 / 4^(1/2.4) - 0.055
  EXPECT_EQ(izb::to_display(stored).rgb[1][2], 1.0f);
  EXPECT_NEAR(izb::to_display(stored, 2.0).rgb[2][1], 1.0f, 1e-6);
  EXPECT_NEAR(izb::to_display(stored, -1.0).rgb[0][1], 0.388573f, 1e-6);
  stored.linear = false;
  EXPECT_EQ(izb::to_display(stored).rgb[0][1], 0.25f);
}

}  // namespace
