// SPDX-License-Identifier: MIT
// Stage `gbuffer` (5.1).
#pragma once
#include "frame/samples.h"
#include "frame/scene_buffers.h"
#include "gpu/memory.h"
#include "gpu/program.h"
#include "gpu/timers.h"

namespace izb {

/// What the eye sees, one texel a pixel, bottom row first.
struct GBuffer {
  gpu::Texture depth;           ///< D32F, reversed: 1 at the near plane
  gpu::Texture id;              ///< RG32UI: entry of DrawList::instances + 1 (0: sky), triangle of its mesh
  gpu::Texture eye_distance;    ///< R32F: t of shared::receiver_point; 0: sky
  gpu::Texture normal;          ///< RG32F: geometric normal on the viewer's side, octahedral, view space
  gpu::Texture shading_normal;  ///< RG16: octahedral in [0, 1], view space
  gpu::Texture micro_quad;      ///< RGBA32F, with several samples a pixel only: shared::micro_quad_data, lifted
  gpu::Texture albedo;          ///< sRGB8; alpha 1 with a shading normal, 1/2 without

  GBuffer() = default;
  GBuffer(int width_px, int height_px, bool micro_quads);
  /// Binds the textures to the units that the later stages read.
  void bind() const;
  size_t bytes() const;
  /// What bytes() will be.
  static gpu::Plan memory_needed(int width_px, int height_px, bool micro_quads);
};

class GBufferStage {
 public:
  GBufferStage();
  /// For frames of that scene. With several samples a pixel: also find each pixel's micro-quad. Makes only what is not
  /// there already.
  void resize(int width_px, int height_px, const SamplePattern& samples, const SceneBuffers& scene);
  /// Draws the scene and finds every pixel's receiver point. The camera's uniform block is bound.
  void render(const SceneBuffers& scene, gpu::StageTimers& timers);
  const GBuffer& gbuffer() const { return gbuffer_; }
  static std::vector<gpu::ProgramSpec> program_specs();

 private:
  gpu::Program draw_, draw_masked_, resolve_, lift_;
  bool lifted_ = false;
  GBuffer gbuffer_;
  gpu::Framebuffer framebuffer_;
};

}  // namespace izb
