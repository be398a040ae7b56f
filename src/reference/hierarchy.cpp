// SPDX-License-Identifier: MIT
#include "reference/hierarchy.h"

#include <cmath>
#include <limits>

namespace izb::reference {
namespace {

constexpr float beyond = std::numeric_limits<float>::infinity();

struct Grown {
  glm::dvec3 lower{beyond}, upper{-beyond};

  void add(const glm::dvec3& p) { lower = glm::min(lower, p), upper = glm::max(upper, p); }
  /// Rounded outwards, and cut to where it must lie.
  Box within(const Box& bounds) const {
    Box box;
    for (int k = 0; k < 3; ++k) {
      box.lower[k] = std::max(std::nextafter(static_cast<float>(lower[k]), -beyond), bounds.lower[k]);
      box.upper[k] = std::min(std::nextafter(static_cast<float>(upper[k]), beyond), bounds.upper[k]);
      if (box.lower[k] > box.upper[k]) box.lower[k] = bounds.lower[k], box.upper[k] = bounds.upper[k];
    }
    return box;
  }
};

}  // namespace

std::array<Box, 2> split_box(const std::array<glm::vec3, 3>& corners, const Box& box, int dimension, float position) {
  const auto at = static_cast<double>(position);
  Grown sides[2];
  for (int i = 0; i < 3; ++i) {
    const glm::dvec3 p(corners[static_cast<size_t>(i)]), q(corners[static_cast<size_t>((i + 1) % 3)]);
    const double from = p[dimension], to = q[dimension];
    if (from <= at) sides[0].add(p);
    if (from >= at) sides[1].add(p);
    if (std::min(from, to) < at && std::max(from, to) > at) {
      glm::dvec3 crossing = p + (q - p) * ((at - from) / (to - from));
      crossing[dimension] = at;
      sides[0].add(crossing), sides[1].add(crossing);
    }
  }
  Box low = box, high = box;
  low.upper[dimension] = std::min(box.upper[dimension], position);
  high.lower[dimension] = std::max(box.lower[dimension], position);
  return {sides[0].within(low), sides[1].within(high)};
}

}  // namespace izb::reference
