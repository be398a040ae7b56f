// SPDX-License-Identifier: MIT
// The picture of the viewer as the batch program writes it: PNG, OpenEXR with every channel, JSON.
#pragma once
#include <string>
#include <vector>

#include "app/rendered_frame.h"
#include "view/frame.h"

namespace izb {

/// Writes STEM.png, STEM.exr and STEM.json, all or none, and returns their names. Throws izb::Error.
std::vector<std::string> write_screenshot(const std::string& stem, const Request& request,
                                          const RenderedFrame& rendered);

}  // namespace izb
