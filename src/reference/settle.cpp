// SPDX-License-Identifier: MIT
#include "reference/settle.h"

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>

#include "base/error.h"
#include "reference/candidates.h"
#include "reference/parallel.h"
#include "reference/witness.h"

namespace izb::reference {
namespace {

/// How far a sample that was found with floats may lie from ours, in world units: derived in docs/VALIDATION.md. The
/// only sample of a pixel is a point of floats itself.
double sample_error(const Triangles& triangles, const Receivers& receivers, size_t i) {
  constexpr double u = 0x1p-24;
  if (receivers.slopes.empty() || receivers.own_triangle[i] == no_triangle) return 0.0;
  const glm::dvec3 p(receivers.center(i)), n = normal(corners(triangles, receivers.own_triangle[i]));
  const glm::dvec3 ray = receivers.camera.perspective ? p : glm::dvec3(0.0, 0.0, -1.0);
  const MicroQuad quad = receivers.quad(i);
  const double grazing = glm::length(n) * glm::length(ray) / std::abs(glm::dot(n, ray));
  const double steepness = std::abs(quad.slope.x) + std::abs(quad.slope.y);
  double error = 2.0 * u * steepness * (1.0 + grazing) * (receivers.camera.perspective ? glm::length(p) : 1.0);
  if (quad.shrink < 1.0) error += 0x1p-17 * glm::length(p);
  return error < double(receivers.band[i]) ? error : double(receivers.band[i]);  // also NaN
}

/// What may shadow a point, by the alpha where the line to the light meets it.
struct Occluders {
  std::vector<Corners> there;    ///< of the point itself
  std::vector<Corners> surely;   ///< of every point within reach
  std::vector<Corners> perhaps;  ///< of some point within reach
  bool doubtful = false;         ///< the three differ

  void find(const Triangles& triangles, std::span<const uint32_t> candidates, const LightPoint& light,
            const glm::dvec3& point, double reach) {
    there.clear(), surely.clear(), perhaps.clear();
    doubtful = false;
    for (const uint32_t t : candidates) {
      const Corners c = corners(triangles, t);
      Presence presence;
      if (triangles.cutouts)
        presence =
            triangles.cutouts->within(t, c, {point, way_to(light, point), reach, light.positional ? reach : 0.0});
      if (presence.there) there.push_back(c);
      if (presence.there && presence.sure) surely.push_back(c);
      if (presence.there || !presence.sure) perhaps.push_back(c);
      doubtful = doubtful || !presence.sure;
    }
  }
};

/// Of a bit that is not `truth`, the truth at the point.
Verdict explain(const Occluders& o, const glm::dvec3& point, double band, bool truth, const LightPoint& light) {
  if (truth_changes_within(point, band, truth, o.there, light)) return Verdict::explained;
  if (!o.doubtful) return Verdict::unexplained;
  // What may be a hole is one, if that lights the point, and none, if that darkens it.
  const std::vector<Corners>& other = truth ? o.surely : o.perhaps;
  const bool changes =
      shadowed_exact(point, other, light) != truth || truth_changes_within(point, band, truth, other, light);
  return changes ? Verdict::explained_by_alpha : Verdict::unexplained;
}

}  // namespace

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
      balls.push_back({receivers.point(i, s), receivers.band[i], receivers.spared(i)});
    }
  }
  result.disputed = bits.size();

  const Candidates candidates = find_candidates(triangles, light, balls);
  parallel_for(bits.size(), 16, 0, [&](size_t begin, size_t end, unsigned) {
    Occluders occluders;
    for (size_t k = begin; k < end; ++k) {
      DisputedBit& bit = bits[k];
      const glm::dvec3& point = balls[k].center_vs;
      const double band = balls[k].radius;
      const double reach = triangles.cutouts ? sample_error(triangles, receivers, bit.receiver) : 0.0;
      occluders.find(triangles, candidates.of(k), light, point, reach);
      const bool truth = shadowed_exact(point, occluders.there, light);
      bit.leak = truth;
      bit.verdict = Verdict::settled_ours;
      if (truth == ((receivers.bits_of(mask[bit.receiver]) >> bit.sample & 1u) != 0)) continue;
      bit.verdict = explain(occluders, point, band, truth, light);
      bit.edge_distance_bands = nearest_edge_distance(point, occluders.there, light) / band;
    }
  });

  for (const DisputedBit& bit : bits) {
    result.verdicts[bit.receiver] = std::max(result.verdicts[bit.receiver], bit.verdict);
    if (bit.verdict == Verdict::settled_ours) {
      ++result.settled_ours;
      continue;
    }
    ++(bit.verdict == Verdict::explained            ? result.explained
       : bit.verdict == Verdict::explained_by_alpha ? result.explained_by_alpha
                                                    : result.unexplained);
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
