// SPDX-License-Identifier: MIT
// All that a shadow technique may read of a frame.
#pragma once
#include <functional>
#include <memory>

#include "frame/gbuffer.h"
#include "frame/samples.h"

namespace izb {

struct FrameInputs {
  int width_px = 0, height_px = 0;
  Camera eye;  ///< in the world; what the stages take of it is `camera`
  shared::CameraFrame camera;
  shared::LightFrame light;
  SamplePattern samples;             ///< where in a pixel the shadow samples lie
  const GBuffer* gbuffer = nullptr;  ///< its textures are bound to their units
  /// Draws triangles of the scene once: attributes position, uv and instance, storage block of instances bound.
  std::function<void(Drawn)> draw_casters;
  /// The same by numbers, for a technique that takes the triangles [first, end) from the bound storage blocks, at most
  /// `most` at once: see SceneBuffers. Only `--raster compute` of izb asks for it.
  std::function<void(Drawn, uint32_t most, const std::function<void(uint32_t first, uint32_t end)>& take)> for_casters;
  bool masked_casters = false;  ///< are there any to which an alpha mask applies?
  /// The frame's triangles in view space on the CPU, in the frame's numbering; made on first use.
  std::function<const std::vector<glm::vec3>&()> triangles_vs;
  /// A number that no other triangles have, so that what was built of them may be kept for all frames with it; 0:
  /// nothing is to be kept.
  uint64_t geometry = 0;
  /// Of each instance (G-buffer id - 1): its first triangle in the frame's numbering.
  const std::vector<uint32_t>* first_triangle = nullptr;
  /// For the alpha masks of techniques on the CPU: what the triangles are of; null: all are opaque.
  const Scene* scene = nullptr;
  const DrawList* draw_list = nullptr;
};

/// What a technique writes: 32 samples a pixel, a set bit is an occluded sample; 0 where there is nothing to shadow. Of
/// one sample a pixel the word is 0 or ~0, unless the technique filters: then its set bits are the share of shadow.
struct Visibility {
  gpu::Texture mask;  ///< R32UI, bottom row first
};

}  // namespace izb
