// SPDX-License-Identifier: MIT
// The irregular z-buffer and its z-cull on the CPU: for tests and debug views.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "shared/lists.h"
#include "shared/pairs.h"
#include "shared/pyramid.h"

namespace izb {

/// Every list from its head, one texel of the grid after another.
struct IzbLists {
  std::vector<uint32_t> first;  ///< of each texel: where its list begins in `nodes`; and the end of the last
  std::vector<uint32_t> nodes;  ///< shared::pixel_from_node (bottom row first); slot_from_node, 0 in a pool

  size_t count() const { return first.size() - 1; }
  std::span<const uint32_t> operator[](size_t texel) const {
    return std::span(nodes).subspan(first[texel], first[texel + 1] - first[texel]);
  }
};

/// Grids have the bottom row first, one layer after another (of each face its cascades); texel() indexes them.
struct IzbInternals {
  int grid = 0, layers = 0;
  IzbLists lists;
  std::vector<float> furthest;  ///< depth of the furthest node, 0: none; empty without z-cull
  std::vector<uint16_t> zcull;  ///< the depth buffer, in steps of 1 / 65535; empty without z-cull
  std::vector<float> pyramid;   ///< read by pyramid_at; empty without a pyramid
  glm::ivec2 pyramid_size{0};   ///< of one layer

  size_t texel(const glm::ivec2& at, int layer) const { return (size_t(layer) * grid + at.y) * grid + at.x; }
  float pyramid_at(int level, const glm::ivec2& at, int layer) const {
    const glm::ivec2 p = shared::pyramid_origin(grid, level) + at;
    return pyramid[(size_t(layer) * pyramid_size.y + p.y) * pyramid_size.x + p.x];
  }
};

/// 64-bit counts of a counting pass.
uint64_t fragments_of(const shared::Counters& c);
uint64_t tests_of(const shared::Counters& c);

}  // namespace izb
