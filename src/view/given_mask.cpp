// SPDX-License-Identifier: MIT
#include "view/given_mask.h"

#include <stdexcept>

#include "frame/read_back.h"

namespace izb {

void GivenMask::render(const FrameInputs& in, Visibility& out, gpu::StageTimers&) {
  if (masks_.empty()) {
    out.mask.clear_uint(0);
    return;
  }
  const std::vector<uint32_t>& mask = masks_[next_++ % masks_.size()];
  if (mask.size() != size_t(in.width_px) * size_t(in.height_px)) throw std::logic_error("a mask of another size");
  const std::vector<uint32_t> rows = flip_rows(mask, in.width_px, in.height_px);
  glTextureSubImage2D(out.mask.name(), 0, 0, 0, in.width_px, in.height_px, GL_RED_INTEGER, GL_UNSIGNED_INT,
                      rows.data());
}

}  // namespace izb
