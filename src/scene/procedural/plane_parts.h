// SPDX-License-Identifier: MIT
// The racing airplane's parts. Its own space: x forward, y up, z to the right wing, the propeller's axis along y = 0.
#pragma once
#include "scene/procedural/parts.h"

namespace izb::procedural {

struct PlanePalette {
  explicit PlanePalette(Builder& b);
  uint32_t red, white, metal, dark, rubber, leather, wood, brass;
};

using Sheet = std::function<glm::dvec3(double u, double v)>;

/// The fuselage: t from the cowl to the tail, turn around from the top over the right side.
glm::dvec3 plane_body(double t, double turn);

/// plane_skin.cpp has the sheets, plane_fittings.cpp what they carry.
class PlaneParts {
 public:
  PlaneParts(Builder& b, const PlanePalette& palette, const glm::dmat4& world_from_plane)
      : b_(b), p_(palette), place_(world_from_plane) {}

  void fuselage() const;
  void cowl() const;
  void engine() const;
  void propeller() const;
  void wings() const;
  void tail() const;
  void gear() const;
  void cockpit() const;

 private:
  Pen pen(uint32_t material, bool left = false) const;
  /// A sheet cut as CAD does it: a fine grid inside, and along each trimmed edge a fringe of slivers.
  void trimmed(const Pen& pen, double cuts_u, double cuts_v, const Sheet& sheet, const glm::dvec3& inside) const;
  void oriented(const Pen& pen, int cuts_u, int cuts_v, const Closing& closing, const Sheet& sheet,
                const glm::dvec3& inside) const;
  void rivets(const Pen& pen, const Sheet& sheet, const glm::dvec3& inside, const glm::dvec2& from,
              const glm::dvec2& to, double spacing) const;
  void wing(bool left) const;
  void cylinder(const glm::dmat4& place) const;

  Builder& b_;
  const PlanePalette& p_;
  glm::dmat4 place_;
};

}  // namespace izb::procedural
