// SPDX-License-Identifier: MIT
// Irregular z-buffer shadows after Wyman, Hoetzlein and Lefohn, "Frustum-Traced Raster Shadows: Revisiting Irregular
// Z-Buffers", I3D 2015.
#pragma once
#include "shadow/technique.h"

namespace izb {

std::unique_ptr<Technique> make_izb();

}  // namespace izb
