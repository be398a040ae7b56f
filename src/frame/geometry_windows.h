// SPDX-License-Identifier: MIT
// Buffers larger than a driver's storage blocks, bound in windows one after another: glsl/shared/geometry.glsl reads
// them as a whole.
#pragma once
#include <cstdint>

#include "gpu/capabilities.h"
#include "gpu/glsl_front_end.h"
#include "gpu/objects.h"

namespace izb {

struct GeometryWindows {
  uint32_t words = 0;  ///< 32-bit words in each but the last
  int positions = 1, indices = 1;

  /// Throws izb::Error where so many windows would be needed that a shader cannot have them.
  GeometryWindows(uint64_t position_bytes, uint64_t index_bytes, const gpu::Capabilities& capabilities);
  GeometryWindows() = default;

  /// For programs that include geometry.glsl; none where one window is enough.
  gpu::Defines defines() const;
  /// Binds a buffer: the first window to `first`, the others to `more` and on.
  void bind(GLuint first, GLuint more, const gpu::Buffer& buffer, int count) const;
};

}  // namespace izb
