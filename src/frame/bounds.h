// SPDX-License-Identifier: MIT
// Stage `bounds` (5.2): fits the light's window to the receivers, on the GPU, without a read-back.
#pragma once
#include "gpu/program.h"
#include "gpu/timers.h"
#include "shared/bounds.h"

namespace izb {

class BoundsStage {
 public:
  BoundsStage();
  /// micro_quads: the windows hold the pixels' micro-quads, not only their centres. Programs for the same stay.
  void prepare(bool micro_quads, int cascades);
  /// Camera and light uniform blocks and the G-buffer's textures are bound; `faces` is the light's. Leaves the windows
  /// bound as BIND_WINDOWS and the cascades' ends as BIND_CASCADE_ENDS, both uniform blocks.
  void render(int faces, gpu::StageTimers& timers);
  /// Binds these as the last render() left them.
  void bind() const;
  /// Reads a layer's window back; for checks and debug views only.
  shared::LightWindow read_window(int layer = 0) const;
  shared::CascadeRange read_cascades() const;
  static std::vector<gpu::ProgramSpec> program_specs();

 private:
  gpu::Program reduce_, reduce_cube_;  ///< made when a light first needs them
  gpu::Program window_program_, range_program_, split_program_;
  gpu::Buffer bounds_, windows_, cascades_buffer_;
  bool micro_quads_ = false;
  int cascades_ = 1;
};

}  // namespace izb
