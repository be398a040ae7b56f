// SPDX-License-Identifier: MIT
// The GPU's deformed vertices against glTF's rules in double precision.
#pragma once
#include <cstdint>

#include "frame/scene_buffers.h"

namespace izb {

struct DeformCheck {
  uint64_t vertices = 0;       ///< of all instances that deform
  uint64_t wrong = 0;          ///< further from their place in double precision than rounding explains, or not finite
  uint64_t not_as_on_cpu = 0;  ///< other bits than the same text gives on the CPU, which the ground truth is about
  double largest_error = 0.0;  ///< in units of what rounding explains
};

/// Reads back what the last SceneBuffers::update() wrote; the scene must be posed as it was then.
///
/// What rounding explains, with u = 2^-24 and absolute values: the sum of a position and T differences, each rounded,
/// is off by at most (T + 1) u times the sum of the terms' sizes; the blend of J joint matrices, themselves rounded,
/// and the product with the position (four terms) by (J + 6) u times the product of sizes.
DeformCheck check_deformation(const Scene& scene, const SceneBuffers& buffers);

}  // namespace izb
