// SPDX-License-Identifier: MIT
// Proof that the exact truth takes the other value near a point: a witness point where it does.
#pragma once
#include <span>

#include "reference/exact.h"

namespace izb::reference {

/// The exact truth at a point: whether any of the listed triangles occludes it.
bool shadowed_exact(const glm::dvec3& point_vs, std::span<const Corners> occluders, const LightPoint& light);

/// Whether a point no further than `band` (world units) from `point_vs` exists, and is found, where the exact
/// truth is not what it is at `point_vs`; `occluders` are all triangles that shadow any point of that ball.
/// Never true without a witness: each one is evaluated exactly.
///
/// In the plane through the point and perpendicular to the light's direction each shadow ends at lines: its
/// edges' and the one where the triangle's plane crosses. These cut the disc of radius `band` into cells, and
/// every cell has a witness: beyond the foot of each line, on each arc of the circle, and in the four sectors
/// at each crossing of two lines (of the nearest 32 lines).
///
/// `truth` is the exact truth at the point.
///  - true (a leak is to be explained): witnesses also lie towards the light and along the occluders'
///  normals.
///  - false (a false shadow): only displacements perpendicular to the light's direction, and only triangles
///  whose plane
///    already lies strictly between point and light at the point itself, so that no plane can explain it.
bool truth_changes_within(const glm::dvec3& point_vs, double band, bool truth, std::span<const Corners> occluders,
                          const LightPoint& light);

/// Distance from the point to the nearest outline edge of any single occluder's shadow, in world units,
/// measured perpendicular to the light's direction; infinity without occluders.
double nearest_edge_distance(const glm::dvec3& point_vs, std::span<const Corners> occluders, const LightPoint& light);

}  // namespace izb::reference
