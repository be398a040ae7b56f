// SPDX-License-Identifier: MIT
// What results are made from, whoever owns it.
#pragma once
#include "app/frame_options.h"
#include "app/gl_setup.h"
#include "shadow/renderer.h"

namespace izb {

/// The renderer's last frame, of that scene, by that technique.
struct RenderedFrame {
  const Scene& scene;
  const FrameChoice& frame;
  const Gl& gl;
  Renderer& renderer;
  Technique& technique;
  const gpu::StageTimers& timers;
};

}  // namespace izb
