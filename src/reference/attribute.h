// SPDX-License-Identifier: MIT
// Which approximation of a technique made a bit wrong, from masks of the same frame with one of them less each time.
#pragma once
#include <cstdint>
#include <vector>

#include "reference/truth.h"

namespace izb::reference {

/// The same frame four times, one word a receiver.
struct MaskTwins {
  std::vector<uint32_t> asked;           ///< with the approximations that were asked for
  std::vector<uint32_t> exact_coverage;  ///< the same without the look-up table
  std::vector<uint32_t> exact_alpha;     ///< and with alpha masks asked at each sample
  std::vector<uint32_t> exact;           ///< and without an approximation of the insertion
};

/// Counts of bits of receivers, each with one cause: what of it differs from asked, but for the bits of the causes
/// before.
struct Attribution {
  uint64_t table = 0;            ///< on which asked and exact_coverage differ
  uint64_t alpha_leaks = 0;      ///< lit as asked, shadowed in exact_alpha
  uint64_t alpha_false = 0;      ///< shadowed as asked, lit in exact_alpha
  uint64_t insertion_leaks = 0;  ///< lit as asked, shadowed in exact
  uint64_t insertion_false = 0;  ///< shadowed as asked, lit in exact
  uint64_t shadowed_bits = 0;    ///< in exact

  /// A number of bits as a share of shadowed_bits.
  double percent(uint64_t bits) const {
    return shadowed_bits ? 100.0 * static_cast<double>(bits) / static_cast<double>(shadowed_bits) : 0.0;
  }
  double leak_percent() const { return percent(insertion_leaks); }
  double alpha_percent() const { return percent(alpha_leaks + alpha_false); }
};

/// One receiver's bits, word by word as Attribution counts them.
struct WrongBits {
  uint32_t table = 0, alpha_leaks = 0, alpha_false = 0, insertion_leaks = 0, insertion_false = 0;
};
WrongBits wrong_bits(const Receivers& receivers, const MaskTwins& twins, size_t i);

/// Throws izb::Error where the arrays differ in length.
Attribution attribute(const Receivers& receivers, const MaskTwins& twins);

}  // namespace izb::reference
