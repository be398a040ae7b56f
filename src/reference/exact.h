// SPDX-License-Identifier: MIT
// The shadow of one triangle at one point, decided without error: determinants in double with a forward error
// bound (the static filter of Shewchuk 1997, "Adaptive Precision Floating-Point Arithmetic and Fast Robust
// Geometric Predicates", orient3d), and in integers of the GNU Multiple Precision library where the bound
// does not decide.
//
// The rule, over the real numbers that the inputs are. A point P, a triangle (a, b, c), the light's direction
// D from P (directional: xyz_vs; positional: xyz_vs - P), den = det(b-a, c-a, D) and num = det(b-a, c-a,
// a-P). The triangle occludes P iff
//   den != 0 (a triangle that is degenerate or edge-on to the light casts nothing),
//   its plane does not hold a positional light (holds_light: rounding would decide what is dark),
//   no edge value det(a-P, b-P, D), det(b-P, c-P, D), det(c-P, a-P, D) has the sign opposite to den (zero is
//   inside), num / den > 0 (the plane lies strictly on the light's side of P), and, positional, num / den < 1
//   (before the light).
// All inputs must be finite.
#pragma once
#include <cstdint>
#include <vector>

#include "reference/truth.h"

namespace izb::reference {

/// One triangle's corners in view space.
struct Corners {
  glm::vec3 a, b, c;
};

inline Corners corners(const Triangles& triangles, size_t triangle) {
  const glm::vec3* v = &triangles.positions_vs[3 * triangle];
  return {v[0], v[1], v[2]};
}

/// Of the triangle's plane, in double, any length.
inline glm::dvec3 normal(const Corners& t) {
  const glm::dvec3 a(t.a);
  return glm::cross(glm::dvec3(t.b) - a, glm::dvec3(t.c) - a);
}

/// Whether the plane passes within light.band and the vertices' rounding (16 units of 2^-24 of the largest |v|_1) of a
/// positional light. A frame's definition, not a truth about it: computed in double.
bool holds_light(const Corners& triangle, const LightPoint& light);

/// Whether the triangle occludes the point: the rule above, exactly. Any finite doubles may be the point.
bool occluded_exact(const glm::dvec3& point_vs, const Corners& triangle, const LightPoint& light);

/// The rule's part about the plane alone: den != 0 and the plane lies strictly between the point and the
/// light.
bool plane_between_exact(const glm::dvec3& point_vs, const Corners& triangle, const LightPoint& light);

/// Distance of the point from the triangle's plane in world units, positive where the plane is on the light's
/// side of the point. The sign is exact, the size off by at most about 1e-15 of the distance to the corners.
/// 0 for a degenerate or edge-on triangle.
double plane_distance(const glm::dvec3& point_vs, const Corners& triangle, const LightPoint& light);

/// The way from the point to the light, of any length.
inline glm::dvec3 way_to(const LightPoint& light, const glm::dvec3& point_vs) {
  return light.positional ? glm::dvec3(light.xyz_vs) - point_vs : glm::dvec3(light.xyz_vs);
}

/// The exact mask by brute force: every sample against every triangle but its receiver's own, on all cores. For
/// small cases. One word a receiver, 0 where it is none: bit s is set where sample s is occluded, all bits where the
/// only sample is. Throws izb::Error where the receivers' arrays differ in length.
std::vector<uint32_t> exact_mask(const Triangles& triangles, const LightPoint& light, const Receivers& receivers);

}  // namespace izb::reference
