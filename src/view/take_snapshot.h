// SPDX-License-Identifier: MIT
// Reads a finished frame back.
#pragma once
#include "shadow/renderer.h"
#include "view/looks.h"

namespace izb {

/// Of the renderer's last frame, by that camera and technique, under one of its lights: size, camera, light, samples,
/// first_triangle and G-buffer with its micro-quads always, and what the flags of Need ask for as far as the technique
/// has it. What the frame has bound must still be: no other renderer has drawn since. `left` takes one frame more, and
/// another one may remove a few nodes others: threads have no order. Not `truth`, `tests` and `fragments`, which are of
/// other frames. Throws izb::Error where the technique says that its mask is wrong.
Snapshot take_snapshot(Renderer& renderer, Technique& technique, const Camera& camera, size_t light, unsigned needs);

}  // namespace izb
