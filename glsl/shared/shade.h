// SPDX-License-Identifier: MIT
// The final render's own inputs (5.6).
#ifndef IZB_SHARED_SHADE_H
#define IZB_SHARED_SHADE_H
#include "shared/lang.h"
SHARED_BEGIN

struct ShadeFrame {
  vec4 up_vs;          // the world's up; w: ambient strength
  vec4 sky_horizon;    // linear colours
  vec4 sky_zenith;
  vec4 ground;         // light from below, and the background below the horizon
  vec4 cone;           // spot: cosines of the inner and outer half-angles
};

SHARED_END
#endif
