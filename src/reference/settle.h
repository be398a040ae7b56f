// SPDX-License-Identifier: MIT
// Settles the bits that a mask and its rays dispute: exactly, and with a proof for each bit that is forgiven.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "reference/truth.h"

namespace izb::reference {

/// What became of a bit, from good to bad. A receiver has the worst of its bits' verdicts.
enum class Verdict : uint8_t {
  not_compared,        ///< not a receiver
  agreed,              ///< mask and ray agree
  settled_ours,        ///< disputed; the exact truth is the mask's: the float ray was wrong
  explained,           ///< the mask differs from the truth, but the truth takes both values within the band
  explained_by_alpha,  ///< and does so only since the alpha of an occluder passes its cut-off within the sample's error
  unexplained,         ///< the mask is wrong
};

/// One explained or unexplained bit.
struct DisputedBit {
  uint32_t receiver = 0;
  uint8_t sample = 0;
  Verdict verdict = Verdict::unexplained;
  bool leak = false;                 ///< lit in the mask, shadowed in truth; otherwise a false shadow
  double edge_distance_bands = 0.0;  ///< to the nearest edge of any nearby occluder, in bands; infinity: none
};

/// Counts are of bits, one a sample, but for those of the pixels left out.
struct Settled {
  uint64_t compared = 0;                           ///< of receivers
  uint64_t lit = 0;                                ///< of them, lit in the mask
  uint64_t shadowed = 0;                           ///< of them, shadowed in the mask
  uint64_t sky = 0, culled = 0, outside_cone = 0;  ///< pixels left out, and why
  uint64_t disputed = 0;                           ///< settled_ours + explained + explained_by_alpha + unexplained
  uint64_t settled_ours = 0;
  uint64_t explained = 0;
  uint64_t explained_by_alpha = 0;
  uint64_t unexplained = 0;
  uint64_t leaks = 0;                ///< explained or unexplained: lit in the mask, shadowed in truth
  uint64_t false_shadow = 0;         ///< explained or unexplained: shadowed in the mask, lit in truth
  double settle_ms = 0.0;            ///< wall time
  std::vector<Verdict> verdicts;     ///< one a receiver
  std::vector<DisputedBit> records;  ///< unexplained ones first, then in the receivers' order; at most `record_cap`
};

/// Compares `mask` (the technique's) with `ray_mask` (RayTracer::trace_mask) on the receivers, bit by bit; with one
/// sample a pixel a word of 16 bits or more is shadow. Each bit that they dispute is decided by the exact truth at the
/// sample's point: the union of the exact shadows of all triangles but the receiver's own. Where the mask is not the
/// truth, the bit is explained only by a witness within `receivers.band` (see witness.h), in particular an edge that
/// two occluders share explains nothing, and a false shadow is never explained by a triangle's plane. A masked triangle
/// counts where its alpha at the hit says so; where the alpha of some hit within the sample's own error says otherwise,
/// it may count as either, and what that alone explains is counted apart. On all cores. Throws izb::Error where the
/// arrays differ in length.
Settled settle(const Triangles& triangles, const LightPoint& light, const Receivers& receivers,
               std::span<const uint32_t> mask, std::span<const uint32_t> ray_mask, size_t record_cap = 10000);

}  // namespace izb::reference
