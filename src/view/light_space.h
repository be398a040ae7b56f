// SPDX-License-Identifier: MIT
// Between the screen and the light-space grid: which texels a pixel stands in, and what each layer spans in the world.
#pragma once
#include <array>
#include <utility>
#include <vector>

#include "shared/insertion.h"
#include "view/snapshot.h"

namespace izb {

/// shared::class_... of pixel i.
uint32_t class_of(const Snapshot& snapshot, size_t i);

/// Pixel i as the shaders count it.
glm::ivec2 shader_px(const Snapshot& snapshot, size_t i);

/// The layer in which stage `build` puts the centre of pixel i, which is not sky. Takes `windows`' cascades.
int layer_of(const Snapshot& snapshot, size_t i);

/// The light as it looks through the face of that layer.
shared::LightFrame face_of_layer(const Snapshot& snapshot, int layer);

/// The micro-quad of a receiver on the grid of its centre's layer. Takes `windows` and micro-quads.
shared::QuadOnGrid quad_on_grid(const Snapshot& snapshot, size_t i);

/// What each layer's window spans over the texels in use and over the depths of its receivers: a box, around a
/// positional light the part of a pyramid. Bit 0 of the corner's number is x, bit 1 y, bit 2 away from the light. A
/// layer without a receiver has eight times the eye.
std::vector<std::array<glm::dvec3, 8>> cascade_frusta_ws(const Snapshot& snapshot);

/// The pixels in a texel's list, as `built`: each once, row by row.
std::vector<glm::ivec2> pixels_of_texel(const Snapshot& snapshot, const glm::ivec2& texel, int layer);

/// The layers and texels in whose lists a pixel stands, as `built`: each once, in the order of `built`.
std::vector<std::pair<int, glm::ivec2>> texels_of_pixel(const Snapshot& snapshot, const glm::ivec2& px);

}  // namespace izb
