// SPDX-License-Identifier: MIT
// Draws shapes into the meshes of a builder, in a space of its own; outsides and normals as in shapes.h.
#pragma once
#include <array>
#include <functional>
#include <glm/glm.hpp>
#include <span>
#include <string>

#include "scene/scene.h"

namespace izb::procedural {

class Builder;

/// A run of meshes of one material, or the one mesh of a part.
struct Batch {
  std::string name;
  uint32_t material = 0;
  bool part = false;
  int mesh = -1;         ///< that is being filled
  size_t triangles = 0;  ///< of all its meshes
};

/// How a surface's grid closes.
struct Closing {
  bool wrap_u = false, wrap_v = false;        ///< the last column or row is the first
  bool pole_begin = false, pole_end = false;  ///< the row v = 0 or v = 1 is one point
};

using Corners = std::array<glm::dvec3, 4>;

class Pen {
 public:
  Pen(Builder& builder, Batch& batch, const glm::dmat4& place) : builder_(&builder), batch_(&batch), place_(place) {}

  /// The same mesh in a space within this one.
  Pen in(const glm::dmat4& pen_from_inner) const { return {*builder_, *batch_, place_ * pen_from_inner}; }
  const Batch& batch() const { return *batch_; }

  void triangle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) const;
  /// Corners counter-clockwise; cut into a grid where detail asks for it.
  void quad(const Corners& corners) const;
  void box(const glm::dvec3& low, const glm::dvec3& high) const;
  /// Over two quads, each counter-clockwise seen from above, `bottom` below `top`.
  void hexahedron(const Corners& bottom, const Corners& top) const;
  /// A straight beam: `thickness` along `up`, `width` across.
  void beam(const glm::dvec3& from, const glm::dvec3& to, double width, double thickness, const glm::dvec3& up) const;
  /// The convex polygon (x, z), counter-clockwise seen from above, from y = low to y = high.
  void prism(std::span<const glm::dvec2> polygon, double low, double high) const;

  void rod(const glm::dvec3& from, const glm::dvec3& to, double radius, int sides) const;
  void tube(std::span<const glm::dvec3> path, double radius, int sides) const;
  void tube(std::span<const glm::dvec3> path, std::span<const double> radii, int sides) const;
  /// An open tube that ends in a point.
  void hair(std::span<const glm::dvec3> path, double radius, int sides) const;
  void ring(const glm::dvec3& center, const glm::dvec3& axis, double ring_radius, double tube_radius, int segments,
            int sides) const;
  void lathe(std::span<const glm::dvec2> profile, int sides) const;  ///< around y; see shapes::add_lathe
  void ball(const glm::dvec3& center, double radius, int sides) const;
  /// p(u, v) for u, v in [0, 1], outside along dp/du x dp/dv; vertices shared, normals smooth.
  void surface(int segments_u, int segments_v, const Closing& closing,
               const std::function<glm::dvec3(double u, double v)>& position) const;

 private:
  bool counts(size_t triangles) const;  ///< true: there is nothing else to do
  Mesh& mesh() const;
  template <typename Add>
  void draw(size_t triangles, const Add& add) const;
  void grid_quad(const Corners& corners, int segments_u, int segments_v) const;

  Builder* builder_;
  Batch* batch_;
  glm::dmat4 place_;
};

}  // namespace izb::procedural
