// SPDX-License-Identifier: MIT
// Colours of the views of stages, and scales that a few extreme values do not spoil.
#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "image/image.h"

namespace izb {

using Rgb = std::array<uint8_t, 3>;

/// Where there is nothing to show: sky, an empty texel. heat_color's scale does not contain it.
inline constexpr Rgb nothing_color{20, 62, 66};

/// A colour for each number, unlike that of its neighbours.
Rgb distinct_color(uint32_t number);
/// A colour for each of many numbers, without an order.
Rgb hashed_color(uint32_t number);
/// 1: the colour itself, 0: black.
Rgb dimmed(const Rgb& color, float share);

/// The next number upwards, or downwards, of 1, 2 or 5 times a power of ten. x > 0.
float nice_above(float x);
float nice_below(float x);

struct ColorScale {
  float low = 0.0f, high = 1.0f;
  bool logarithmic = false;
  Rgb color(float value) const;
};

/// From 0 to above all but the largest 1/200 of the values.
ColorScale scale_of(std::vector<float> values);
/// Likewise without the smallest 1/200. The values are positive.
ColorScale log_scale_of(std::vector<float> values);

/// As a person writes it: "0.02 m".
std::string with_unit(float value, const char* unit);

/// A picture in RGB, all `nothing_color`.
Image8 blank(int width_px, int height_px);
inline void put(Image8& picture, size_t i, const Rgb& color) {
  std::copy(color.begin(), color.end(), picture.pixels.begin() + std::ptrdiff_t(3 * i));
}

}  // namespace izb
