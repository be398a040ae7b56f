// SPDX-License-Identifier: MIT
// One side of a comparison on the GPU: a technique and a renderer that stay as long as their options do.
#pragma once
#include <memory>

#include "app/rendered_frame.h"
#include "shadow/renderer.h"
#include "view/frame.h"
#include "view/given_mask.h"

namespace izb {

/// What both sides draw.
struct Stage3D {
  const Scene& scene;
  const Gl& gl;
  std::shared_ptr<SceneBuffers> buffers;
};

class Side {
 public:
  /// Renders the frame; an expected failure becomes the picture's sentence. What `between_draws` of the buffers throws
  /// goes through. `technique`: null: as the state says.
  SidePicture paint(const Stage3D& stage, const SideState& state, const FrameChoice& frame, int light, bool at_rest);
  /// The same by masks that are there already.
  SidePicture paint_given(const Stage3D& stage, const SamplePattern& samples,
                          const std::vector<std::vector<uint32_t>>& masks, const FrameChoice& frame, int light);
  /// Everything is made anew for the next picture: other shaders, another scene, a frame that was given up.
  void forget();

  bool ready() const { return renderer_ != nullptr; }
  Renderer& renderer() { return *renderer_; }
  Technique& technique() { return *technique_; }
  const gpu::StageTimers& timers() const { return timers_; }

 private:
  SidePicture render(const Stage3D& stage, const FrameChoice& frame, int light, bool at_rest);

  SideState state_;
  bool given_ = false;
  std::unique_ptr<Technique> technique_;
  std::unique_ptr<Renderer> renderer_;
  gpu::StageTimers timers_{true};
};

}  // namespace izb
