// SPDX-License-Identifier: MIT
// The parts of the garden, each in its own space: metres, y up, standing on y = 0 and sunk a little below it
// so that no bottom face lies in a floor. garden.cpp places them.
#pragma once
#include <glm/glm.hpp>
#include <vector>

#include "scene/random.h"
#include "scene/scene.h"

namespace izb::garden {

constexpr double degree = 0.017453292519943295;
constexpr double sunk = -0.025;  ///< height of the underside of whatever stands on the floor

/// A point on the line from a to b that hangs `sag` below it half-way (a parabola, which a taut catenary is).
glm::dvec3 on_line(const glm::dvec3& a, const glm::dvec3& b, double sag, double t);

// garden_site.cpp: what is built of stone and plaster.
int paving_rows(const Bounds& area);
Mesh paving(Random& random, const Bounds& area);
Mesh raised_bed(double width, double depth);  ///< the border only
Mesh steps();
Mesh urn();
Mesh ball();
Mesh pedestal();

// garden_wood.cpp: what is built of laths and beams.
Mesh trellis(double width, double bottom, double top,
             double spacing);  ///< in the plane z = 0, centred on x = 0
Mesh pergola(const Bounds& area);
Mesh ladder();                ///< upright, centred on x = 0; lean it by turning about x
Mesh chair();                 ///< faces +z
Mesh crate();                 ///< 0.5 m wide, open slats
Mesh door();                  ///< on a wall whose face is z = 0, towards +z
Mesh shutters();              ///< likewise
Mesh railing(double length);  ///< iron rods along x, centred

// garden_wires.cpp: what is thin.
Mesh wire(const glm::dvec3& a, const glm::dvec3& b, double sag, double radius);
Mesh bulb();  ///< hangs from the origin
Mesh cloth(double width, double height, double fold_m,
           double phase);  ///< hangs from y = 0 in the plane z = 0

/// A bicycle that heads for +x and stands on its wheels and its stand.
struct Bicycle {
  Mesh paint, metal, rubber, leather;
};
Bicycle bicycle();

// garden_plants.cpp
Mesh grass_patch(Random& random, double size, int blades, double shortest, double longest);
Mesh grass_tuft(Random& random);

struct Tree {
  Mesh wood, leaves;
};
Tree tree(Random& random);

}  // namespace izb::garden
