// SPDX-License-Identifier: MIT
#include "image/mask_metrics.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <stdexcept>

namespace izb {
namespace {

/// With bit s for sample s and no other bit.
uint32_t bits_of(uint32_t word, int spp) {
  return spp == 1 ? word != 0 : word;
}

void check(std::span<const uint32_t> reference, std::span<const uint32_t> test, int spp,
           std::span<const uint8_t> counted) {
  if (reference.size() != test.size() || (!counted.empty() && counted.size() != test.size()))
    throw std::logic_error("masks to compare differ in size");
  if (spp != 1 && spp != 32) throw std::logic_error("a mask has 1 or 32 samples a pixel");
}

}  // namespace

int samples_of(std::span<const uint32_t> mask) {
  return std::all_of(mask.begin(), mask.end(), [](uint32_t word) { return word == 0 || word == ~0u; }) ? 1 : 32;
}

float coverage_error(uint32_t reference, uint32_t test, int spp) {
  return float(std::popcount(bits_of(test, spp)) - std::popcount(bits_of(reference, spp))) / float(spp);
}

MaskDifference compare_masks(std::span<const uint32_t> reference, std::span<const uint32_t> test, int spp,
                             std::span<const uint8_t> counted) {
  check(reference, test, spp, counted);
  MaskDifference sums;
  sums.spp = spp;
  for (size_t i = 0; i < reference.size(); ++i) {
    if (!counted.empty() && !counted[i]) continue;
    const uint32_t a = bits_of(reference[i], spp), b = bits_of(test[i], spp);
    ++sums.pixels;
    sums.shadowed += uint64_t(std::popcount(a));
    if (a == b) continue;
    ++sums.differing_pixels;
    sums.leaks += uint64_t(std::popcount(a & ~b));
    sums.false_shadow += uint64_t(std::popcount(b & ~a));
    const double error = std::abs(double(coverage_error(reference[i], test[i], spp)));
    sums.coverage_error_sum += error;
    sums.largest_coverage_error = std::max(sums.largest_coverage_error, error);
  }
  sums.bits = sums.pixels * uint64_t(spp);
  return sums;
}

Image8 mask_difference_picture(std::span<const uint32_t> reference, std::span<const uint32_t> test, int spp,
                               std::span<const uint8_t> counted, int width_px, int height_px) {
  check(reference, test, spp, counted);
  constexpr int lit = 120, shadowed = 50, faintest = 160;  // already one sample must be seen
  Image8 picture{width_px, height_px, 3, std::vector<uint8_t>(3 * reference.size())};
  for (size_t i = 0; i < reference.size(); ++i) {
    if (!counted.empty() && !counted[i]) continue;
    const uint32_t a = bits_of(reference[i], spp), b = bits_of(test[i], spp);
    const auto grey = uint8_t(lit + (shadowed - lit) * std::popcount(a) / spp);
    const auto strength = [&](uint32_t wrong) {
      return uint8_t(wrong == 0 ? (a == b ? grey : grey / 2)
                                : faintest + (255 - faintest) * std::popcount(wrong) / spp);
    };
    uint8_t* const px = &picture.pixels[3 * i];
    px[0] = strength(a & ~b);
    px[1] = a == b ? grey : uint8_t(grey / 2);
    px[2] = strength(b & ~a);
  }
  return picture;
}

}  // namespace izb
