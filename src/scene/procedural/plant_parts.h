// SPDX-License-Identifier: MIT
// What the power plant is made of.
#pragma once
#include <vector>

#include "scene/procedural/parts.h"

namespace izb::procedural {

struct PlantPalette {
  explicit PlantPalette(Builder& b);
  uint32_t concrete, earth, asphalt, white, steel, grating, cladding, lagging, rust, yellow, blue, coal;
  uint32_t pipes[6];
};

struct PlantParts {
  Builder& b;
  const PlantPalette& p;

  /// An I-section: `up` is across its flanges.
  void girder(uint32_t material, const glm::dvec3& from, const glm::dvec3& to, double depth,
              const glm::dvec3& up) const;
  void truss(uint32_t material, const glm::dvec3& from, const glm::dvec3& to, double height, int bays) const;
  void pylon(const glm::dvec3& foot, double height, double width) const;  ///< four legs with lattice
  void grating(const glm::dvec3& low, const glm::dvec3& high) const;      ///< bars in one level
  void railing(const glm::dvec3& from, const glm::dvec3& to) const;
  void stair(const glm::dvec3& foot, double turn_deg, double rise, double width) const;
  void corrugated(const glm::dvec3& low, const glm::dvec3& high) const;  ///< an upright sheet, outside to its right
  void ribs(const glm::dvec3& low, const glm::dvec3& high, double step) const;
  void door(uint32_t material, const glm::dvec3& foot, double width, double height) const;

  /// A pipe whose corners are rounded.
  void pipe(const Pen& pen, const std::vector<glm::dvec3>& way, double radius, double sides) const;
  /// The same with flanges, hangers and valves.
  void pipe_run(uint32_t material, const std::vector<glm::dvec3>& way, double radius, Random& random) const;
  void flange(uint32_t material, const glm::dvec3& at, const glm::dvec3& axis, double radius) const;
  void valve(uint32_t material, const glm::dvec3& at, const glm::dvec3& axis, double radius) const;
  void vessel(uint32_t material, const glm::dvec3& from, const glm::dvec3& to, double radius) const;
  void duct(const glm::dvec3& from, const glm::dvec3& to, double width) const;
  void tank(const glm::dvec3& foot, double radius, double height) const;
  void silo(const glm::dvec3& foot, double radius, double height) const;
  void chimney(const glm::dvec3& foot, double radius, double height) const;
  void cooling_tower(const glm::dvec3& foot, double radius, double height) const;
  void ventilator(const glm::dvec3& foot) const;

 private:
  double few() const;
};

}  // namespace izb::procedural
