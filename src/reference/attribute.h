// SPDX-License-Identifier: MIT
// Which approximation of a technique made a bit wrong, from masks of the same frame with one of them less each time.
#pragma once
#include <cstdint>
#include <vector>

#include "reference/truth.h"

namespace izb::reference {

/// The same frame three times, one word a receiver.
struct MaskTwins {
  std::vector<uint32_t> asked;           ///< with the approximations that were asked for
  std::vector<uint32_t> exact_coverage;  ///< the same without the look-up table
  std::vector<uint32_t> exact;           ///< and without an approximation of the insertion
};

/// Counts of bits of receivers. The bits of insertion are those on which asked and exact differ, but the table's.
struct Attribution {
  uint64_t table = 0;            ///< on which asked and exact_coverage differ
  uint64_t insertion_leaks = 0;  ///< lit as asked, shadowed in exact
  uint64_t insertion_false = 0;  ///< shadowed as asked, lit in exact
  uint64_t shadowed_bits = 0;    ///< in exact

  /// insertion_leaks as a share of shadowed_bits.
  double leak_percent() const {
    return shadowed_bits ? 100.0 * static_cast<double>(insertion_leaks) / static_cast<double>(shadowed_bits) : 0.0;
  }
};

/// One receiver's bits, word by word as Attribution counts them.
struct WrongBits {
  uint32_t table = 0, insertion_leaks = 0, insertion_false = 0;
};
WrongBits wrong_bits(const Receivers& receivers, const MaskTwins& twins, size_t i);

/// Throws izb::Error where the arrays differ in length.
Attribution attribute(const Receivers& receivers, const MaskTwins& twins);

}  // namespace izb::reference
