// SPDX-License-Identifier: MIT
// Which triangles can matter to a point: those whose shadow can touch a ball around it. Never too few; the
// exact predicate throws out the rest.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "reference/truth.h"

namespace izb::reference {

/// For each query point a list of triangle indices, ascending.
struct Candidates {
  std::vector<size_t> first;        ///< one entry a point, and the end
  std::vector<uint32_t> triangles;  ///< all lists, one after another

  std::span<const uint32_t> of(size_t point) const {
    return {triangles.data() + first[point], first[point + 1] - first[point]};
  }
};

/// A ball: its truth is asked at `center_vs` and at points no further than `radius` away, in world units.
struct Ball {
  glm::dvec3 center_vs;
  float radius;
  uint32_t spared;  ///< a triangle that is left out of the ball's list
};

/// For each ball every triangle that occludes some point of it (and some that do not). Balls and triangles
/// are projected along the light (directional: orthographic; positional: onto the six faces of a cube around
/// the light, triangles clipped to each face's pyramid), and one pass over the triangles looks the balls up
/// in a 2-D grid. In double, with slack for its rounding; on all cores.
Candidates find_candidates(const Triangles& triangles, const LightPoint& light, std::span<const Ball> balls);

}  // namespace izb::reference
