// SPDX-License-Identifier: MIT
// A bounding volume hierarchy over a frame's triangles, as plain data, for traversals of our own.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "reference/truth.h"

namespace izb::reference {

struct Box {
  glm::vec3 lower{0.0f}, upper{0.0f};
};

/// Binary. Built by Embree's builder at its highest quality: surface area heuristic with spatial splits, after which
/// several leaves may refer to one triangle.
struct Hierarchy {
  static constexpr uint32_t largest_leaf = 4;  ///< references

  struct Child {
    Box box;
    uint32_t first = 0;  ///< of a leaf: its first reference; else: the node
    uint32_t count = 0;  ///< references; 0: no leaf
  };
  using Node = std::array<Child, 2>;

  std::vector<Node> nodes;           ///< the root comes first; empty where the root is a leaf
  std::vector<uint32_t> references;  ///< triangles; of one leaf one after another
  Child root;
  int depth = 0;  ///< nodes on the longest way from the root to a leaf
  double build_ms = 0.0;
};

/// On `threads` threads, 0: all cores. Throws izb::Error without Embree, without triangles, and for an error that
/// Embree reports.
Hierarchy build_hierarchy(const Triangles& triangles, unsigned threads = 0);

/// The boxes of the triangle's two parts, within `box`, on both sides of the plane at `position` of that dimension.
/// Never too small.
std::array<Box, 2> split_box(const std::array<glm::vec3, 3>& corners, const Box& box, int dimension, float position);

}  // namespace izb::reference
