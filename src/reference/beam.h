// SPDX-License-Identifier: MIT
// How many frustum-triangle tests does a ray tracer need? (Wyman et al. 2015, figure 10: "a beam tracer using
// state-of-the-art acceleration structures".) One beam a receiver, from its micro-quad to the light.
#pragma once
#include <cstdint>
#include <vector>

#include "reference/hierarchy.h"

namespace izb::reference {

/// What beams met.
struct BeamCount {
  uint64_t pixels = 0;      ///< receivers, a beam each
  uint64_t tests = 0;       ///< triangles that beams were tested against, a triangle once for each leaf it is in
  uint64_t node_tests = 0;  ///< boxes that beams were tested against
  std::vector<uint32_t> tests_a_pixel;  ///< of each receiver
  std::vector<uint32_t> mask;           ///< one word a receiver, as exact_mask() has them
  double build_ms = 0.0, trace_ms = 0.0;
};

/// A hierarchy over one frame's triangles, whose beams are the convex hulls of a receiver's samples and the light; with
/// one sample a ray. The nearest child comes first, and a beam ends when all of its samples are in shadow.
class BeamTracer {
 public:
  /// `threads` 0 means all cores, for the build and for tracing. Throws as build_hierarchy().
  explicit BeamTracer(const Triangles& triangles, unsigned threads = 0);

  /// Throws izb::Error where the receivers' arrays differ in length.
  BeamCount trace(const LightPoint& light, const Receivers& receivers) const;

  const Hierarchy& hierarchy() const { return hierarchy_; }

 private:
  Triangles triangles_;
  unsigned threads_;
  Hierarchy hierarchy_;
  double largest_ = 0.0;  ///< of all coordinates
};

}  // namespace izb::reference
