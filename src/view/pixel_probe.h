// SPDX-License-Identifier: MIT
// All about one pixel, for the lens: its samples on the tangent plane, and by which triangles they are hidden. By the
// definition in double (shared/coverage.h, shared/occlusion.h) over all triangles. No GL.
#pragma once
#include <array>
#include <span>
#include <utility>
#include <vector>

#include "view/snapshot.h"

namespace izb {

struct Occluder {
  uint32_t triangle;  ///< in the frame's numbering
  /// Its edges ab, bc, ca as the light casts them, and its own plane less the bias: f0, fx, fy of f0 + o.x fx + o.y fy
  /// over offsets o in pixels from the pixel's centre; inside all four are positive. Each has a scale of its own.
  std::array<glm::dvec3, 4> lines;
  uint32_t bits;  ///< samples that it hides; at one sample a pixel all or none
};

struct ProbedPixel {
  glm::ivec2 px;  ///< top row first
  bool receiver;  ///< asks for shadows; else the arrays below are empty, but for its samples
  uint32_t mask;  ///< 0 where the snapshot has none
  std::vector<glm::vec2> samples_px;
  /// Corners of the micro-quad and its samples on the tangent plane, in widths of a pixel at that distance; the
  /// receiver point is 0, x and y point right and up as far as the plane allows.
  std::array<glm::dvec2, 4> micro_quad_tangent;
  std::vector<glm::dvec2> samples_tangent;
  /// What hides a sample, most samples first; no more than most_occluders. An alpha mask's holes are not seen: of a
  /// masked triangle some of these bits may be lit in the mask.
  std::vector<Occluder> occluders;
  std::array<uint32_t, 2> counts;  ///< triangles that hide a sample; of these, those that alone hide one
  uint32_t hidden;                 ///< samples that any of them hides
  std::vector<std::pair<int, glm::ivec2>> texels;  ///< layers and texels that it stands in; empty without `built`
};

inline constexpr size_t most_occluders = 64;

/// `triangles_vs` as FrameInputs gives them: three vertices each. At one sample a pixel the answer is shared::occludes;
/// the micro-quad and the lines are then those that the pixel would have, if the snapshot knows its triangle.
ProbedPixel probe(const Snapshot& snapshot, std::span<const glm::vec3> triangles_vs, const glm::ivec2& px);

}  // namespace izb
