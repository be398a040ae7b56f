// SPDX-License-Identifier: MIT
// Stage `bounds` (5.2): fits the light's window to the receivers, on the GPU, without a read-back.
#pragma once
#include "gpu/program.h"
#include "gpu/timers.h"
#include "shared/light.h"

namespace izb {

class BoundsStage {
 public:
  BoundsStage();
  /// Camera and light uniform blocks and the G-buffer's textures are bound. Leaves the window bound as BIND_WINDOW.
  void render(gpu::StageTimers& timers);
  /// Reads the window back; for checks and debug views only.
  shared::LightWindow read_window() const;
  static std::vector<gpu::ProgramSpec> program_specs();

 private:
  gpu::Program reduce_, window_program_;
  gpu::Buffer bounds_, window_;
};

}  // namespace izb
