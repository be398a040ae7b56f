// SPDX-License-Identifier: MIT
// Stage `shade` (5.6).
#pragma once
#include "gpu/memory.h"
#include "gpu/program.h"
#include "gpu/timers.h"

namespace izb {

class ShadeStage {
 public:
  ShadeStage();
  void resize(int width_px, int height_px);
  /// Camera, light and shade uniform blocks and the G-buffer's textures are bound.
  void render(const gpu::Texture& mask, gpu::StageTimers& timers);
  const gpu::Texture& picture() const { return picture_; }  ///< RGBA16F, linear
  /// What picture() will take.
  static gpu::Plan memory_needed(int width_px, int height_px);
  static std::vector<gpu::ProgramSpec> program_specs();

 private:
  gpu::Program program_;
  gpu::Texture picture_;
};

}  // namespace izb
