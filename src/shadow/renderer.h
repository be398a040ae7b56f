// SPDX-License-Identifier: MIT
// The spine: gbuffer, bounds, [build, zcull, visibility: the technique's], shade.
#pragma once
#include "frame/bounds.h"
#include "frame/scene_buffers.h"
#include "frame/shade.h"
#include "frame/uniform_block.h"
#include "shadow/technique.h"

namespace izb {

class Renderer {
 public:
  /// The scene must outlive the renderer. Throws izb::Error if the driver refuses a buffer or a program.
  Renderer(const Scene& scene, const gpu::Capabilities& capabilities);

  /// Fixes size, technique and its options. Throws izb::Error if the size is beyond the driver's limits, there is too
  /// little memory, or the technique lacks a capability.
  void prepare(Technique& technique, int width_px, int height_px);

  /// One frame. Stage times go to `timers`.
  void render(const Camera& camera, const Light& light, gpu::StageTimers& timers);

  /// Counts of the last frame, by a frame of their own.
  Counts count();

  const FrameInputs& inputs() const { return inputs_; }  ///< of the last frame
  const gpu::Texture& mask() const { return visibility_.mask; }
  /// The words of the last frame's mask, top row first. Throws izb::Error where the technique says that they are wrong.
  std::vector<uint32_t> read_mask() const;
  const gpu::Texture& picture() const { return shade_.picture(); }
  const BoundsStage& bounds() const { return bounds_; }
  const SceneBuffers& scene_buffers() const { return buffers_; }
  /// GPU memory by group: "izb" or the technique's name with the mask, "gbuffer" with the picture, "scene".
  Counts memory() const;
  /// What memory() will be after prepare(), before exact insertion's pool grows.
  gpu::Plans memory_needed(const Technique& technique, int width_px, int height_px) const;
  /// What there was for all of it at the last prepare().
  const gpu::Room& room() const { return room_; }

  /// All programs that any technique compiles, and the frame's own. Needs no GL.
  static std::vector<gpu::ProgramSpec> program_specs();

 private:
  const Scene& scene_;
  gpu::Capabilities capabilities_;
  SceneBuffers buffers_;
  Technique* technique_ = nullptr;
  GBufferStage gbuffer_;
  BoundsStage bounds_;
  ShadeStage shade_;
  UniformBlock<shared::CameraFrame> camera_block_;
  UniformBlock<shared::LightFrame> light_block_;
  UniformBlock<shared::ShadeFrame> shade_block_;
  UniformBlock<shared::SampleFrame> samples_block_;
  gpu::Room room_;
  Visibility visibility_;
  FrameInputs inputs_;
  std::vector<shared::InstanceFrame> instances_;
  std::vector<glm::vec3> triangles_vs_;  ///< of the last frame, once asked for
};

}  // namespace izb
