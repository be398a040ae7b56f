// SPDX-License-Identifier: MIT
// A technique's approximations turned off one after the other, on the same frame.
#pragma once
#include <optional>

#include "app/session.h"
#include "reference/attribute.h"

namespace izb {

/// Whether the frame is rendered with approximations: of `coverage` or `insertion` at 32 samples a pixel, or of the
/// `alpha` of casters that have a mask.
bool approximates(Session& session, Technique& technique);

/// Of each light the masks as asked, with `coverage` exact, with `alpha` exact, too, and with `insertion` exact, too:
/// the last frame's own and one more for each that was not. Afterwards the options are as before and the frame is
/// rendered again.
std::vector<reference::MaskTwins> render_twins(Session& session, Technique& technique);

}  // namespace izb
