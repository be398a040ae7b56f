// SPDX-License-Identifier: MIT
// The sRGB transfer function (IEC 61966-2-1), in the precision of its argument: in single precision 1 is encoded as
// 0.99999994.
#pragma once
#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstdint>

namespace izb {

/// Linear light in [0, 1] to its sRGB code value in [0, 1].
template <std::floating_point T>
T linear_to_srgb(T linear) {
  return linear <= T(0.0031308) ? T(12.92) * linear : T(1.055) * std::pow(linear, T(1) / T(2.4)) - T(0.055);
}

/// An sRGB code value in [0, 1] to linear light in [0, 1].
template <std::floating_point T>
T srgb_to_linear(T srgb) {
  return srgb <= T(0.04045) ? srgb / T(12.92) : std::pow((srgb + T(0.055)) / T(1.055), T(2.4));
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
