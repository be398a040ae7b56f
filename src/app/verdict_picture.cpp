// SPDX-License-Identifier: MIT
#include "app/verdict_picture.h"

#include <array>
#include <bit>

namespace izb {
namespace {

using Color = std::array<uint8_t, 3>;

Color grey_of(const reference::Receivers& receivers, uint32_t word) {
  constexpr int lit = 170, shadowed = 70;
  const int bits = std::popcount(receivers.bits_of(word)), all = receivers.sample_count();
  const auto value = static_cast<uint8_t>(lit + (shadowed - lit) * bits / all);
  return {value, value, value};
}

}  // namespace

Image8 verdict_picture(const reference::Receivers& receivers, const reference::Settled& settled,
                       const std::vector<uint32_t>& mask, const reference::MaskTwins* twins, Size size) {
  using reference::Verdict;
  Image8 picture{size.width_px, size.height_px, 3, {}};
  for (size_t i = 0; i < mask.size(); ++i) {
    const Verdict verdict = settled.verdicts[i];
    const reference::WrongBits wrong = twins ? reference::wrong_bits(receivers, *twins, i) : reference::WrongBits{};
    const Color color = verdict == Verdict::not_compared               ? Color{120, 120, 120}
                        : verdict == Verdict::unexplained              ? Color{255, 0, 0}
                        : wrong.insertion_leaks != 0                   ? Color{255, 0, 255}
                        : wrong.table != 0                             ? Color{0, 255, 255}
                        : (wrong.alpha_leaks | wrong.alpha_false) != 0 ? Color{0, 200, 60}
                        : verdict == Verdict::explained                ? Color{255, 220, 0}
                        : verdict == Verdict::explained_by_alpha       ? Color{0, 200, 60}
                        : verdict == Verdict::settled_ours             ? Color{60, 90, 255}
                                                                       : grey_of(receivers, mask[i]);
    picture.pixels.insert(picture.pixels.end(), color.begin(), color.end());
  }
  return picture;
}

}  // namespace izb
