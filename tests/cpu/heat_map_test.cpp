// SPDX-License-Identifier: MIT
#include "image/heat_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "image/srgb.h"

namespace {

using Color = std::array<uint8_t, 3>;

/// CIE L* of an sRGB colour: another measure of lightness than the one that the map is made with.
double lightness(const Color& color) {
  const auto linear = [&](size_t i) { return double(izb::srgb_to_linear(float(color[i]) / 255.0f)); };
  const double y = 0.2126 * linear(0) + 0.7152 * linear(1) + 0.0722 * linear(2);
  return y > 0.008856 ? 116.0 * std::cbrt(y) - 16.0 : 903.3 * y;
}

TEST(HeatMap, GetsLighterAllTheWay) {
  double last = lightness(izb::heat_color(0.0f)) - 2.0;
  for (int i = 0; i <= 32; ++i) {
    const double now = lightness(izb::heat_color(float(i) / 32.0f));
    EXPECT_GT(now, last + 1.0) << "step " << i;
    EXPECT_LT(now, last + 6.0) << "step " << i;
    last = now;
  }
  EXPECT_LT(lightness(izb::heat_color(0.0f)), 10.0);
  EXPECT_GT(lightness(izb::heat_color(1.0f)), 90.0);
}

TEST(HeatMap, ClampsAndMarksNaN) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  EXPECT_EQ(izb::heat_color(-3.0f), izb::heat_color(0.0f));
  EXPECT_EQ(izb::heat_color(infinity), izb::heat_color(1.0f));
  const Color nan = izb::heat_color(std::numeric_limits<float>::quiet_NaN());
  for (int i = 0; i <= 255; ++i) EXPECT_NE(izb::heat_color(float(i) / 255.0f), nan);
}

TEST(HeatMap, ScalesByTheLargestValue) {
  const std::vector<float> values = {0.0f, 5.0f, 10.0f, 20.0f};
  const izb::Image8 picture = izb::heat_map(values, 2, 2, 10.0f);
  ASSERT_EQ(picture.pixels.size(), 12u);
  for (size_t i = 0; i < 4; ++i) {
    const Color color = {picture.pixels[3 * i], picture.pixels[3 * i + 1], picture.pixels[3 * i + 2]};
    EXPECT_EQ(color, izb::heat_color(values[i] / 10.0f));
  }
  EXPECT_THROW(izb::heat_map(values, 3, 2, 1.0f), std::logic_error);
  EXPECT_THROW(izb::heat_map(values, 2, 2, 0.0f), std::logic_error);
}

}  // namespace
