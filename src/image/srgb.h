// SPDX-License-Identifier: MIT
// The sRGB transfer function (IEC 61966-2-1).
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>

namespace izb {

/// Linear light in [0, 1] to its sRGB code value in [0, 1].
inline float linear_to_srgb(float linear) {
  return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f;
}

/// An sRGB code value in [0, 1] to linear light in [0, 1].
inline float srgb_to_linear(float srgb) {
  return srgb <= 0.04045f ? srgb / 12.92f : std::pow((srgb + 0.055f) / 1.055f, 2.4f);
}

/// Light clamped to what a display shows, [0, 1]. NaN becomes 0.
inline float clamp_to_display(float linear) {
  return linear > 0.0f ? std::min(linear, 1.0f) : 0.0f;
}

/// Linear light to the nearest 8-bit sRGB code, clamped to [0, 1] first. NaN becomes 0.
inline uint8_t to_srgb8(float linear) {
  return uint8_t(std::lround(255.0f * linear_to_srgb(clamp_to_display(linear))));
}

}  // namespace izb
