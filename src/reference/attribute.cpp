// SPDX-License-Identifier: MIT
#include "reference/attribute.h"

#include <bit>

#include "base/error.h"

namespace izb::reference {

WrongBits wrong_bits(const Receivers& receivers, const MaskTwins& twins, size_t i) {
  if (receivers.classes[i] != PixelClass::receiver) return {};
  const uint32_t asked = receivers.bits_of(twins.asked[i]), exact = receivers.bits_of(twins.exact[i]);
  const uint32_t masked = receivers.bits_of(twins.exact_alpha[i]);
  const uint32_t table = asked ^ receivers.bits_of(twins.exact_coverage[i]);
  const uint32_t others = ~table & ~(asked ^ masked);
  return {table, masked & ~asked & ~table, asked & ~masked & ~table, exact & ~asked & others, asked & ~exact & others};
}

Attribution attribute(const Receivers& receivers, const MaskTwins& twins) {
  receivers.check("attribute wrong bits");
  for (const auto* mask : {&twins.asked, &twins.exact_coverage, &twins.exact_alpha, &twins.exact})
    if (mask->size() != receivers.count())
      fail("cannot attribute wrong bits: {} points come with {} mask words", receivers.count(), mask->size());
  Attribution sums;
  const auto count = [](uint32_t bits) { return static_cast<unsigned>(std::popcount(bits)); };
  for (size_t i = 0; i < receivers.count(); ++i) {
    if (receivers.classes[i] != PixelClass::receiver) continue;
    const WrongBits wrong = wrong_bits(receivers, twins, i);
    sums.table += count(wrong.table);
    sums.insertion_leaks += count(wrong.insertion_leaks);
    sums.insertion_false += count(wrong.insertion_false);
    sums.alpha_leaks += count(wrong.alpha_leaks);
    sums.alpha_false += count(wrong.alpha_false);
    sums.shadowed_bits += count(receivers.bits_of(twins.exact[i]));
  }
  return sums;
}

}  // namespace izb::reference
