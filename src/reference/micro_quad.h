// SPDX-License-Identifier: MIT
// Where in space the shadow samples of a pixel lie: on the tangent plane of what its centre sees (Wyman et al. 2015,
// 4).
#pragma once
#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

namespace izb::reference {

/// How the camera moves from pixel to pixel, x to the right, y upwards.
struct PixelSteps {
  glm::dvec2 step{0.0};  ///< world units a pixel; perspective: at eye distance 1
  bool perspective = true;
};

/// A pixel's footprint on the tangent plane: offsets in pixels from the centre become points.
struct MicroQuad {
  glm::dvec3 center_vs;
  glm::dvec2 step{0.0};   ///< world units a pixel at the centre's depth, shrunk
  glm::dvec2 slope{0.0};  ///< change a pixel, shrunk; perspective: of 1/t, as a share of the centre's; otherwise of t
  double shrink = 1.0;    ///< below 1: drawn together towards the centre
  bool perspective = false;

  /// The offset (0, 0) is the centre itself, without rounding.
  glm::dvec3 at(const glm::dvec2& offset_px) const {
    const double change = offset_px.x * slope.x + offset_px.y * slope.y;
    const glm::dvec2 across(offset_px.x * step.x, offset_px.y * step.y);
    // One quotient for three: this is within the time of tracing.
    if (perspective) return (center_vs + glm::dvec3(across, 0.0)) * (1.0 / (1.0 + change));
    return center_vs + glm::dvec3(across, -change);
  }
};

/// The slopes of the plane through the point with this normal (any length): how 1/t (perspective, as a share of the
/// point's own) or t (orthographic, in world units) changes from pixel to pixel, t the distance along -z. Not finite
/// where the plane is seen edge-on.
inline glm::dvec2 tangent_slopes(const glm::dvec3& point_vs, const glm::dvec3& normal_vs, const PixelSteps& camera) {
  const double along_ray = camera.perspective ? glm::dot(normal_vs, point_vs / -point_vs.z) : normal_vs.z;
  return glm::dvec2(normal_vs) * camera.step / along_ray;
}

/// The footprint is shrunk where a corner of the pixel would lie at less than half or more than twice the centre's
/// distance, or behind the camera: 1/t (orthographic: t) at the corners then differs by half of its value. Where the
/// slopes are not finite, every sample is the centre.
inline MicroQuad micro_quad(const glm::dvec3& point_vs, const glm::dvec2& slopes, const PixelSteps& camera) {
  const double t = -point_vs.z;
  const double limit = camera.perspective ? 1.0 : t, sum = std::abs(slopes.x) + std::abs(slopes.y);
  if (!std::isfinite(sum)) return {point_vs, glm::dvec2(0.0), glm::dvec2(0.0), 0.0, camera.perspective};
  const double shrink = sum > limit ? limit / sum : 1.0;
  const double scale = camera.perspective ? t : 1.0;
  return {point_vs, camera.step * (scale * shrink), slopes * shrink, shrink, camera.perspective};
}

}  // namespace izb::reference
