// SPDX-License-Identifier: MIT
// Reads a finished frame back.
#pragma once
#include "shadow/renderer.h"
#include "view/looks.h"

namespace izb {

/// Of the renderer's last frame, by that camera and technique, under one of its lights: size, camera, light, samples,
/// first_triangle and G-buffer with its micro-quads always, and what the flags of Need ask for as far as the technique
/// has it. `left` takes one frame more. Not `truth`, `tests` and `fragments`, which are of other frames. Throws
/// izb::Error where the technique says that its mask is wrong.
Snapshot take_snapshot(Renderer& renderer, Technique& technique, const Camera& camera, size_t light, unsigned needs);

}  // namespace izb
