// SPDX-License-Identifier: MIT
// The micro-quad lies on the plane of the one triangle that the pixel's centre sees. Where the surface bends up beside that
// triangle, part of the micro-quad lies below the surface, and dark: a line along each concave edge, and acne all over a
// surface whose triangles are smaller than pixels. Lifted, the micro-quad is as parallel as before and clears the surface
// as the neighbouring pixels see it.
#ifndef IZB_SHARED_LIFT_H
#define IZB_SHARED_LIFT_H
#include "shared/micro_quad.h"
SHARED_BEGIN

// How high a neighbouring pixel's point lies over this pixel's plane, in world units, counts if it is no higher than a pixel
// is wide. What is lower than rounding is none: a flat floor stays where it is.
SHARED bool is_rise(float rise, IN(vec3) p, float pixel_width) {
  return rise > 16.0f * unit_roundoff * norm1(p) && rise < pixel_width;
}

// And if the two are one surface: their planes at most 60 degrees apart, and no step, over which the neighbour's plane would
// pass as high as it does. way: from this pixel's point to the neighbour's.
SHARED bool bends_up(IN(vec3) way, float rise, IN(vec3) normal, IN(vec3) its_normal) {
  return dot(its_normal, way) < 0.8f * rise && dot(normal, its_normal) > 0.5f;
}

// The eye distance at which the micro-quad clears surfaces that rise so high. Half of it: samples reach half-way to the next
// pixel, where a surface that bends up evenly or at one edge has risen by no more.
SHARED float lifted_distance(IN(CameraFrame) camera, IN(vec3) p, IN(vec3) normal, float t, float rise) {
  float facing = is_perspective(camera) ? -dot(normal, p) / t : normal.z;
  return max(t - 0.5f * rise / max(facing, 1.0e-6f), 0.5f * t);
}

SHARED_END
#endif
