// SPDX-License-Identifier: MIT
// How much of each pixel the light reaches: what masks of every kind have in common.
#pragma once
#include <vector>

#include "shadow/renderer.h"

namespace izb::bench {

/// Of the renderer's last frame under its first light, top row first: the share of each receiver's samples that are
/// lit; 0 for what is no receiver (sky, faces turned away, outside a spot's cone). Throws izb::Error where the mask is
/// wrong.
std::vector<float> lit_share(const Renderer& renderer);

/// Whether each pixel is a receiver.
std::vector<uint8_t> receivers_of(const Renderer& renderer);

/// Whether each pixel's eight neighbours lie on its tangent plane, off by no more than 1/64 of a pixel's width: there
/// one plane is a fair model of what is in the pixel. Of the renderer's last frame, top row first.
std::vector<uint8_t> flat_pixels(const Renderer& renderer);

}  // namespace izb::bench
