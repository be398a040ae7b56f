// SPDX-License-Identifier: MIT
#include "reference/attribute.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "reference_fixture.h"

namespace izb::reference {
namespace {

Receivers sampled_receivers(size_t count) {
  Random random(1);
  Receivers receivers;
  receivers.offsets_px = random_offsets(random);
  for (size_t i = 0; i < count; ++i) add_receiver(receivers, {0, 0, 0});
  return receivers;
}

TEST(Attribute, EachWrongBitHasOneCause) {
  Receivers receivers = sampled_receivers(2);
  receivers.classes[1] = PixelClass::culled;
  // Bit 0: the table's. Bit 1: leaked. Bits 2 and 3: false shadow. Bit 4: the table's, though the insertion errs there,
  // too. Bit 5: wrong without the table only, so the table's. Bits 16 and 18: wrong by the alpha mask, whatever the
  // insertion adds; bit 17: leaked. The rest is right.
  const MaskTwins twins{{0b0000'1101u | 0x1ff00u, dark},
                        {0b0011'1100u | 0x1ff00u, 0},
                        {0b0011'1100u | 0x4ff00u, 0},
                        {0b0001'0010u | 0x6ff00u, 0}};
  const WrongBits wrong = wrong_bits(receivers, twins, 0);
  EXPECT_EQ(wrong.table, 0b0011'0001u);
  EXPECT_EQ(wrong.insertion_leaks, 0b0000'0010u | 0x20000u);
  EXPECT_EQ(wrong.alpha_leaks, 0x40000u);
  EXPECT_EQ(wrong.alpha_false, 0x10000u);
  EXPECT_EQ(wrong.insertion_false, 0b0000'1100u);
  EXPECT_EQ(wrong_bits(receivers, twins, 1).table, 0u);
  const Attribution sums = attribute(receivers, twins);
  EXPECT_EQ(sums.table, 3u);
  EXPECT_EQ(sums.insertion_leaks, 2u);
  EXPECT_EQ(sums.insertion_false, 2u);
  EXPECT_EQ(sums.alpha_leaks, 1u);
  EXPECT_EQ(sums.alpha_false, 1u);
  EXPECT_EQ(sums.shadowed_bits, 12u);
  EXPECT_DOUBLE_EQ(sums.leak_percent(), 200.0 / 12.0);
  EXPECT_DOUBLE_EQ(sums.alpha_percent(), 200.0 / 12.0);
}

TEST(Attribute, NothingIsWrongWhereAllAgree) {
  const Receivers receivers = sampled_receivers(3);
  const std::vector<uint32_t> mask{0, dark, 0};
  const Attribution sums = attribute(receivers, {mask, mask, mask, mask});
  EXPECT_EQ(sums.table + sums.insertion_leaks + sums.insertion_false + sums.alpha_leaks + sums.alpha_false, 0u);
  EXPECT_EQ(sums.shadowed_bits, 32u);
  EXPECT_EQ(attribute(receivers, {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}}).leak_percent(), 0.0);
  EXPECT_THROW(attribute(receivers, {mask, mask, mask, {0, 0}}), Error);
}

}  // namespace
}  // namespace izb::reference
