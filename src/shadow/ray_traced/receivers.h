// SPDX-License-Identifier: MIT
// From a rendered G-buffer to what the ground truth works on.
#pragma once
#include "frame/frame_inputs.h"
#include "frame/read_back.h"
#include "reference/truth.h"

namespace izb {

/// The receiver points of a frame, one a pixel, top row first; each with the band of 1/64 pixel in which a bit may be
/// explained. The frame's shadow samples lie on the tangent plane of each pixel's own triangle, computed in double.
reference::Receivers make_receivers(const GBufferImage& image, const FrameInputs& in);

/// The frame's triangles, and the alpha masks of those that have one.
reference::Triangles make_triangles(const FrameInputs& in);

reference::LightPoint make_light_point(const shared::LightFrame& light);

}  // namespace izb
