// SPDX-License-Identifier: MIT
// From float images to pictures to look at. Wrong arguments are bugs and throw std::logic_error.
#pragma once
#include <array>
#include <span>

#include "image/image.h"

namespace izb {

/// A rectangle of pixels; x and y, from the top left, name its first one.
struct PixelRect {
  int x = 0, y = 0, width = 0, height = 0;
};

/// All channels of a part of an image, without attributes: they tell of the whole. It must lie within.
Image crop(const Image& image, const PixelRect& part);

/// An image smaller by a whole factor, which must divide both sides: each value is the mean of factor x factor values,
/// so of linear light where the image holds that. Channels of integers and attributes are left out.
Image box_filter(const Image& image, int factor);

/// The sRGB picture of an image with channels R, G, B in linear light.
Image8 preview(const Image& image);

/// Each pixel as factor x factor equal ones.
Image8 magnify(const Image8& picture, int factor);

/// Pictures of one height in RGB from left to right, with a gap of one colour between them.
Image8 side_by_side(std::span<const Image8> pictures, int gap_px, const std::array<uint8_t, 3>& gap_color);

}  // namespace izb
