// SPDX-License-Identifier: MIT
// The final render's own inputs (5.6).
#ifndef IZB_SHARED_SHADE_H
#define IZB_SHARED_SHADE_H
#include "shared/light.h"
SHARED_BEGIN

struct ShadeFrame {
  vec4 up_vs;          // the world's up; w: ambient strength
  vec4 sky_horizon;    // linear colours
  vec4 sky_zenith;
  vec4 ground;         // light from below, and the background below the horizon
  vec4 cone;           // spot: cosines of the inner and outer half-angles; others: below every cosine
  vec4 strength;       // x: of the light, y: 1 / range of a positional light, 0: no limit
};

// By what the picture multiplies the strength of all lights.
struct Exposure {
  vec4 scale;  // x
};

const int meter_side = 128;  // points along a side of the picture at which light is measured

// What arrives at a point that nothing hides (KHR_lights_punctual: inverse square, and the window of Karis 2013 at the range).
SHARED float arriving_light(IN(LightFrame) light, IN(ShadeFrame) shade, IN(vec3) p) {
  if (!is_positional(light)) return shade.strength.x;
  vec3 to_light = vec3(light.origin) - p;
  float distance2 = max(dot(to_light, to_light), 1.0e-20f);
  float from_axis = -dot(vec3(light.axis_z), to_light) / sqrt(distance2);
  float x = clamp((from_axis - shade.cone.y) / max(shade.cone.x - shade.cone.y, 0.0001f), 0.0f, 1.0f);
  float cone = x * x * (3.0f - 2.0f * x);
  float far = distance2 * shade.strength.y * shade.strength.y;
  return shade.strength.x * cone * max(1.0f - far * far, 0.0f) / distance2;
}

SHARED_END
#endif
