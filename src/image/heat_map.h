// SPDX-License-Identifier: MIT
// Numbers as colours.
#pragma once
#include <array>
#include <cstdint>
#include <span>

#include "image/image.h"

namespace izb {

/// The sRGB colour of a number in [0, 1] (clamped): from near black through violet, red and orange to pale
/// yellow. The perceived lightness (OKLab's L; Ottosson 2020) rises in equal steps, so the map also reads in
/// grey. NaN is a blue-green that the scale does not contain.
std::array<uint8_t, 3> heat_color(float value);

/// A picture of `values` (width times height, top row first): 0 and below is the scale's dark end,
/// `max_value` and above its bright end. Throws std::logic_error if the number of values is wrong or
/// max_value is not positive.
Image8 heat_map(std::span<const float> values, int width_px, int height_px, float max_value);

}  // namespace izb
