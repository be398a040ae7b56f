// SPDX-License-Identifier: MIT
// Shadows by Embree on the CPU, at the same sample points: the ground truth as a technique, and the peer to beat.
#pragma once
#include "shadow/technique.h"

namespace izb {

std::unique_ptr<Technique> make_ray_traced();

}  // namespace izb
