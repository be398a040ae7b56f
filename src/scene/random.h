// SPDX-License-Identifier: MIT
// Random numbers that are the same on every machine; the standard library's distributions are not.
// Two draws in one call's arguments come in an order that compilers choose: give each a statement of its own.
#pragma once
#include <cstdint>

namespace izb {

/// SplitMix64 (Steele, Lea and Flood 2014): a 64-bit counter through a mixing function.
class Random {
 public:
  explicit Random(uint64_t seed) : state_(seed) {}

  uint64_t bits() {
    state_ += 0x9e3779b97f4a7c15ull;
    uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
    return z ^ (z >> 31);
  }
  /// Uniform in [low, high), with 53 random bits.
  double between(double low, double high) { return low + (high - low) * (static_cast<double>(bits() >> 11) * 0x1p-53); }
  /// Uniform in [0, count).
  uint32_t below(uint32_t count) { return static_cast<uint32_t>((bits() >> 32) * count >> 32); }

 private:
  uint64_t state_;
};

}  // namespace izb
