// SPDX-License-Identifier: MIT
// Parts that several procedural scenes are made of.
#pragma once
#include <span>

#include "scene/procedural/builder.h"

namespace izb::procedural {

/// A hole in a wall.
struct Opening {
  double left, right, bottom, top;
};

/// A wall along x from 0 to `length`, from y = bottom to top, its outer face at z = 0 towards +z. Cut along openings,
/// so that no face lies in another.
void add_wall(const Pen& pen, double length, double bottom, double top, double thickness,
              std::span<const Opening> openings);

/// A frame with bars in the opening of such a wall, `depth` behind its face; a pane behind the bars if `glass` is
/// given.
void add_window(const Pen& frame, const Pen* glass, const Opening& opening, double depth, int columns, int rows);

/// Solid steps along +x that rise from y = 0, `width` wide along z from z = 0.
void add_steps(const Pen& pen, int count, double rise, double tread, double width);

/// A turned post of stone that stands on y = 0.
void add_baluster(const Pen& pen, double height, double radius, int sides);

/// A column with base and capital that stands on y = 0.
void add_column(const Pen& pen, double height, double radius, int sides);

/// Stem and crown. The leaves are triangles scattered over the crown's outside.
struct TreeShape {
  double height, crown_radius, crown_bottom;
  bool pointed = false;  ///< a cypress instead of a broad crown
};
void add_tree(const Pen& wood, const Pen& leaves, Random random, const TreeShape& shape, int leaf_count, double leaf_m,
              int sides);

/// Curved blades of grass over the rectangle around the origin, of `height` and less.
void add_blade(const Pen& pen, const glm::dvec3& root, double height, double width, double facing, double bend,
               int levels);

/// Smooth noise in [-1, 1] with features of size 1; fractal noise sums octaves of it.
double noise(const glm::dvec3& p, uint32_t seed);
double fractal_noise(glm::dvec3 p, int octaves, uint32_t seed);

}  // namespace izb::procedural
