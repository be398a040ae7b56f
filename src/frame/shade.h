// SPDX-License-Identifier: MIT
// Stage `shade` (5.6).
#pragma once
#include "gpu/memory.h"
#include "gpu/program.h"
#include "shared/shade.h"

namespace izb {

/// For each frame begin(), then for each light in turn measure() if its exposure is measured, expose(), then for each
/// light add(). The camera, light and shade uniform blocks and the G-buffer's textures are bound.
class ShadeStage {
 public:
  ShadeStage();
  void resize(int width_px, int height_px);
  /// Strengths are multiplied by `exposure` unless expose() says otherwise.
  void begin(float exposure = 1.0f);
  /// Adds what the bound light brings to points all over the picture.
  void measure();
  /// Makes the measured light as bright as a sun alone would be.
  void expose();
  /// Shades by the bound light and its mask; the first one brings sky and ambient light along.
  void add(const gpu::Texture& mask, bool first);
  const gpu::Texture& picture() const { return picture_; }  ///< RGBA16F, linear
  shared::Exposure read_exposure() const { return exposure_.read<shared::Exposure>(1)[0]; }
  /// What picture() will take.
  static gpu::Plan memory_needed(int width_px, int height_px);
  static std::vector<gpu::ProgramSpec> program_specs();

 private:
  gpu::Program program_, meter_, expose_;
  gpu::Texture picture_;
  gpu::Buffer meter_points_, exposure_;
};

}  // namespace izb
