// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <span>

#include "image/image.h"

namespace izb {

/// The picture dimmed to grey, and over it where two masks differ: orange where only `a` is lit, blue where only `b`
/// is, the stronger the more samples. Four components; masks a word a pixel. Throws std::logic_error for other sizes.
Image8 difference_picture(const Image8& picture, std::span<const uint32_t> a, std::span<const uint32_t> b);

}  // namespace izb
