// SPDX-License-Identifier: MIT
// How far one shadow mask is from another, bit by bit. A mask is a word a pixel, top row first: bit s is sample s, set
// where it is in shadow; with one sample a pixel any word but 0 is shadow.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "image/image.h"

namespace izb {

/// 1 if every word is 0 or 0xFFFFFFFF, as masks of one sample a pixel are; otherwise 32.
int samples_of(std::span<const uint32_t> mask);

/// Counts are of bits, one a sample of a compared pixel, but for those of pixels.
struct MaskDifference {
  int spp = 1;
  uint64_t pixels = 0;                                            ///< compared
  uint64_t differing_pixels = 0;                                  ///< of them, with at least one differing bit
  uint64_t bits = 0;                                              ///< compared: pixels times spp
  uint64_t shadowed = 0;                                          ///< of them, in shadow in the reference
  uint64_t leaks = 0;                                             ///< lit in the test, in shadow in the reference
  uint64_t false_shadow = 0;                                      ///< in shadow in the test, lit in the reference
  double coverage_error_sum = 0.0, largest_coverage_error = 0.0;  ///< of pixels' |coverage_error()|

  uint64_t differing() const { return leaks + false_shadow; }
  uint64_t lit() const { return bits - shadowed; }
  /// 0 where nothing is compared.
  double mean_coverage_error() const { return pixels ? coverage_error_sum / double(pixels) : 0.0; }
};

/// By how much the share of a pixel's samples that are in shadow is larger in `test`, in [-1, 1].
float coverage_error(uint32_t reference, uint32_t test, int spp);

/// Compares the pixels where `counted` is not 0, or all where it is empty. `spp` is 1 or 32. Throws std::logic_error
/// if the spans differ in length.
MaskDifference compare_masks(std::span<const uint32_t> reference, std::span<const uint32_t> test, int spp,
                             std::span<const uint8_t> counted = {});

/// The reference as a grey between two, and over it red for leaks and blue for false shadow, the stronger the more
/// samples; pixels that are not counted are black.
Image8 mask_difference_picture(std::span<const uint32_t> reference, std::span<const uint32_t> test, int spp,
                               std::span<const uint8_t> counted, int width_px, int height_px);

}  // namespace izb
