// SPDX-License-Identifier: MIT
// A technique's approximations turned off one after the other, on the same frame.
#pragma once
#include <optional>

#include "app/session.h"
#include "reference/attribute.h"

namespace izb {

/// Whether the technique's options ask for an approximation of `coverage` or `insertion` at 32 samples a pixel.
bool approximates(Technique& technique);

/// Of each light the masks as asked, with `coverage` exact, and with `insertion` exact, too: the last frame's own and
/// two more. Afterwards the options are as before and the frame is rendered again.
std::vector<reference::MaskTwins> render_twins(Session& session, Technique& technique);

}  // namespace izb
