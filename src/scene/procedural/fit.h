// SPDX-License-Identifier: MIT
#pragma once
#include "scene/procedural/builder.h"

namespace izb::procedural {

/// The scene that `build` makes, at the detail that comes nearest to `triangles`. `usual` is its number at detail 1,
/// about.
Scene fitted(const char* name, void (*build)(Builder&), uint32_t seed, size_t triangles, size_t usual);

}  // namespace izb::procedural
