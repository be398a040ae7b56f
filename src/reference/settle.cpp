// SPDX-License-Identifier: MIT
#include "reference/settle.h"

#include <algorithm>
#include <chrono>

#include "base/error.h"
#include "reference/candidates.h"
#include "reference/parallel.h"
#include "reference/witness.h"

namespace izb::reference {
namespace {

void check_lengths(const Receivers& receivers, size_t mask, size_t ray_mask) {
  const size_t count = receivers.points_vs.size();
  if (receivers.own_triangle.size() != count || receivers.classes.size() != count || receivers.band.size() != count ||
      mask != count || ray_mask != count)
    fail(
        "cannot compare masks: {} points come with {} triangles, {} classes, {} bands, {} mask words and {} "
        "ray words",
        count, receivers.own_triangle.size(), receivers.classes.size(), receivers.band.size(), mask, ray_mask);
}

}  // namespace

Settled settle(const Triangles& triangles, const LightPoint& light, const Receivers& receivers,
               std::span<const uint32_t> mask, std::span<const uint32_t> ray_mask, size_t record_cap) {
  check_lengths(receivers, mask.size(), ray_mask.size());
  const auto start = std::chrono::steady_clock::now();
  Settled result;
  result.verdicts.assign(mask.size(), Verdict::not_compared);
  std::vector<uint32_t> disputed;
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
    ++result.compared;
    ++(mask[i] ? result.shadowed : result.lit);
    result.verdicts[i] = Verdict::agreed;
    if ((mask[i] != 0) == (ray_mask[i] != 0)) continue;
    disputed.push_back(i);
    balls.push_back({receivers.points_vs[i], receivers.band[i], receivers.own_triangle[i]});
  }
  result.disputed = disputed.size();

  const Candidates candidates = find_candidates(triangles, light, balls);
  std::vector<DisputedBit> bits(disputed.size());
  parallel_for(disputed.size(), 16, 0, [&](size_t begin, size_t end, unsigned) {
    std::vector<Corners> occluders;
    for (size_t k = begin; k < end; ++k) {
      const uint32_t i = disputed[k];
      const glm::dvec3 point(receivers.points_vs[i]);
      const double band = receivers.band[i];
      occluders.clear();
      for (const uint32_t t : candidates.of(k)) occluders.push_back(corners(triangles, t));
      const bool truth = shadowed_exact(point, occluders, light);
      bits[k] = {i, Verdict::settled_ours, truth, 0.0};
      if (truth == (mask[i] != 0)) continue;
      bits[k].verdict =
          truth_changes_within(point, band, truth, occluders, light) ? Verdict::explained : Verdict::unexplained;
      bits[k].edge_distance_bands = nearest_edge_distance(point, occluders, light) / band;
    }
  });

  for (const DisputedBit& bit : bits) {
    result.verdicts[bit.receiver] = bit.verdict;
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
