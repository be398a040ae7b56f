// SPDX-License-Identifier: MIT
#include "view/difference.h"

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <stdexcept>

namespace izb {

Image8 difference_picture(const Image8& picture, std::span<const uint32_t> a, std::span<const uint32_t> b) {
  if (picture.components != 4 || picture.pixels.size() != 4 * a.size() || a.size() != b.size())
    throw std::logic_error("masks and picture differ in size");
  Image8 image = picture;
  for (size_t i = 0; i < a.size(); ++i) {
    uint8_t* px = &image.pixels[4 * i];
    const int grey = (px[0] * 54 + px[1] * 183 + px[2] * 19) / 1024;  // Rec. 709 luma, a quarter of it
    const int lit_in_a = std::popcount(b[i]) - std::popcount(a[i]);
    // Already one sample must be seen.
    const int strength = lit_in_a == 0 ? 0 : 80 + 175 * std::abs(lit_in_a) / 32;
    px[0] = static_cast<uint8_t>(lit_in_a > 0 ? std::max(grey, strength) : grey);
    px[1] = static_cast<uint8_t>(std::max(grey, strength / 2));
    px[2] = static_cast<uint8_t>(lit_in_a < 0 ? std::max(grey, strength) : grey);
  }
  return image;
}

}  // namespace izb
