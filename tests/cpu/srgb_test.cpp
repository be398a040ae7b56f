// SPDX-License-Identifier: MIT
#include "image/srgb.h"

#include <gtest/gtest.h>

#include <limits>

namespace {

TEST(Srgb, EveryCodeSurvivesTheRoundTrip) {
  for (int code = 0; code < 256; ++code) {
    EXPECT_EQ(izb::to_srgb8(izb::srgb_to_linear(float(code) / 255.0f)), code);
  }
}

TEST(Srgb, HasTheStandardsValues) {
  EXPECT_NEAR(izb::linear_to_srgb(0.0031308f), 0.04045f, 1e-6f);
  EXPECT_NEAR(izb::linear_to_srgb(0.18f), 0.4613561f, 1e-6f);
  EXPECT_NEAR(izb::srgb_to_linear(0.5f), 0.2140411f, 1e-6f);
  EXPECT_FLOAT_EQ(izb::srgb_to_linear(0.02f), 0.02f / 12.92f);
}

TEST(Srgb, CodesAreClamped) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  EXPECT_EQ(izb::to_srgb8(-1.0f), 0);
  EXPECT_EQ(izb::to_srgb8(7.0f), 255);
  EXPECT_EQ(izb::to_srgb8(infinity), 255);
  EXPECT_EQ(izb::to_srgb8(-infinity), 0);
  EXPECT_EQ(izb::to_srgb8(std::numeric_limits<float>::quiet_NaN()), 0);
}

}  // namespace
