// SPDX-License-Identifier: MIT
// The alpha channels that masked materials read, joined into one buffer: any number of them is bound at once.
#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "scene/scene.h"

namespace izb {

struct AlphaMaps {
  std::vector<glm::uvec4> of_material;  ///< shared::MaterialFrame::alpha, one a material of the scene
  uint64_t texel_count = 0;             ///< of all maps, a byte each; 0: no material is masked
};

/// Where each map will stand. Throws izb::Error where a texture has more texels a side than a map may have.
AlphaMaps plan_alpha_maps(const Scene& scene);

/// All maps one after another.
std::vector<uint8_t> join_alpha_maps(const Scene& scene, const AlphaMaps& maps);

}  // namespace izb
