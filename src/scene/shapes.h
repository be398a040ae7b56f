// SPDX-License-Identifier: MIT
// Solid shapes and sheets appended to a mesh. Every triangle is counter-clockwise seen from outside, none is
// degenerate, and every vertex gets a unit normal: smooth along curves, flat on faces. Lengths in metres.
#pragma once
#include <functional>
#include <glm/glm.hpp>
#include <span>

#include "scene/scene.h"

namespace izb::shapes {

/// An axis-aligned box from `low` to `high`.
void add_box(Mesh& mesh, const glm::dvec3& low, const glm::dvec3& high);

/// An axis-aligned box without its bottom, whose upper edges are cut by `bevel` at 45 degrees.
void add_slab(Mesh& mesh, const glm::dvec3& low, const glm::dvec3& high, double bevel);

/// A straight beam from `from` to `to` with a rectangular section: `thickness` along `up` (made perpendicular
/// to the beam), `width` across.
void add_beam(Mesh& mesh, const glm::dvec3& from, const glm::dvec3& to, double width, double thickness,
              const glm::dvec3& up);

/// A capped tube along `path` (at least two points) with one radius a point.
void add_tube(Mesh& mesh, std::span<const glm::dvec3> path, std::span<const double> radii, int sides);

/// A capped tube of constant radius along `path`.
void add_tube(Mesh& mesh, std::span<const glm::dvec3> path, double radius, int sides);

/// A straight capped tube.
void add_rod(Mesh& mesh, const glm::dvec3& from, const glm::dvec3& to, double radius, int sides);

/// A torus around `axis` (unit length).
void add_ring(Mesh& mesh, const glm::dvec3& center, const glm::dvec3& axis, double ring_radius, double tube_radius,
              int segments, int sides);

/// The body that `profile` (radius, height) sweeps around the y axis. The profile runs so that the outside
/// lies to its right with radius to the right and height up: upwards along an outer wall. Radius 0 is allowed
/// at its two ends only. A point given twice is a crease.
void add_lathe(Mesh& mesh, std::span<const glm::dvec2> profile, int sides);

/// The sheet p(u, v) for u, v in [0, 1], with normals along dp/du x dp/dv.
void add_sheet(Mesh& mesh, int segments_u, int segments_v,
               const std::function<glm::dvec3(double u, double v)>& position);

}  // namespace izb::shapes
