// SPDX-License-Identifier: MIT
#include "reference/settle.h"

#include <algorithm>
#include <bit>
#include <chrono>

#include "base/error.h"
#include "reference/candidates.h"
#include "reference/parallel.h"
#include "reference/witness.h"

namespace izb::reference {
Settled settle(const Triangles& triangles, const LightPoint& light, const Receivers& receivers,
               std::span<const uint32_t> mask, std::span<const uint32_t> ray_mask, size_t record_cap) {
  receivers.check("compare masks");
  if (mask.size() != receivers.count() || ray_mask.size() != receivers.count())
    fail("cannot compare masks: {} points come with {} mask words and {} ray words", receivers.count(), mask.size(),
         ray_mask.size());
  const auto start = std::chrono::steady_clock::now();
  Settled result;
  result.verdicts.assign(mask.size(), Verdict::not_compared);
  const auto samples = static_cast<unsigned>(receivers.sample_count());
  std::vector<DisputedBit> bits;
  std::vector<Ball> balls;
  for (uint32_t i = 0; i < mask.size(); ++i) {
    switch (receivers.classes[i]) {
      case PixelClass::sky:
        ++result.sky;
        continue;
      case PixelClass::culled:
        ++result.culled;
        continue;
      case PixelClass::outside_cone:
        ++result.outside_cone;
        continue;
      case PixelClass::receiver:
        break;
    }
    const uint32_t ours = receivers.bits_of(mask[i]);
    const auto shadowed = static_cast<unsigned>(std::popcount(ours));
    result.compared += samples;
    result.shadowed += shadowed;
    result.lit += samples - shadowed;
    result.verdicts[i] = Verdict::agreed;
    for (uint32_t open = ours ^ receivers.bits_of(ray_mask[i]); open != 0; open &= open - 1) {
      const int s = std::countr_zero(open);
      bits.push_back({.receiver = i, .sample = static_cast<uint8_t>(s)});
      balls.push_back({receivers.point(i, s), receivers.band[i], receivers.own_triangle[i]});
    }
  }
  result.disputed = bits.size();

  const Candidates candidates = find_candidates(triangles, light, balls);
  parallel_for(bits.size(), 16, 0, [&](size_t begin, size_t end, unsigned) {
    std::vector<Corners> occluders;
    for (size_t k = begin; k < end; ++k) {
      DisputedBit& bit = bits[k];
      const glm::dvec3& point = balls[k].center_vs;
      const double band = balls[k].radius;
      occluders.clear();
      for (const uint32_t t : candidates.of(k)) occluders.push_back(corners(triangles, t));
      const bool truth = shadowed_exact(point, occluders, light);
      bit.leak = truth;
      bit.verdict = Verdict::settled_ours;
      if (truth == ((receivers.bits_of(mask[bit.receiver]) >> bit.sample & 1u) != 0)) continue;
      bit.verdict =
          truth_changes_within(point, band, truth, occluders, light) ? Verdict::explained : Verdict::unexplained;
      bit.edge_distance_bands = nearest_edge_distance(point, occluders, light) / band;
    }
  });

  for (const DisputedBit& bit : bits) {
    result.verdicts[bit.receiver] = std::max(result.verdicts[bit.receiver], bit.verdict);
    if (bit.verdict == Verdict::settled_ours) {
      ++result.settled_ours;
      continue;
    }
    ++(bit.verdict == Verdict::explained ? result.explained : result.unexplained);
    ++(bit.leak ? result.leaks : result.false_shadow);
    result.records.push_back(bit);
  }
  std::stable_partition(result.records.begin(), result.records.end(),
                        [](const DisputedBit& bit) { return bit.verdict == Verdict::unexplained; });
  if (result.records.size() > record_cap) result.records.resize(record_cap);
  result.settle_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace izb::reference
