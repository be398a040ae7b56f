// SPDX-License-Identifier: MIT
// Alpha masks of triangles (glTF: a point is there if its alpha is at least the cut-off), in double and by a formula of
// its own: the texture of level 0, filtered exactly.
#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <vector>

#include "scene/scene.h"

namespace izb::reference {

struct Corners;

/// Whether a triangle is there where a line hits it.
struct Presence {
  bool there = true;
  bool sure = true;  ///< no line within the reach that was asked about says otherwise
};

/// A line, and the lines around it that are asked about, too.
struct Beam {
  glm::dvec3 point, direction;
  double reach = 0.0;  ///< by how much they are moved at most where they meet a triangle, in world units
  double turn = 0.0;   ///< by how much their directions differ from its own
};

/// Of each triangle of a frame the mask that applies to it, if one does.
class Cutouts {
 public:
  /// Copies the alpha channels of the scene's masked materials.
  explicit Cutouts(const Scene& scene);

  /// The frame's next triangle; `uvs` are its corners' in the order of its vertices, three, or null: all zero.
  void add(uint32_t material, const glm::vec2* uvs);
  void add_opaque(size_t count) { entries_.insert(entries_.end(), count, opaque); }

  bool masked(size_t triangle) const { return triangle < entries_.size() && entries_[triangle] != opaque; }

  /// At the point of the triangle's plane that the beam's line meets, however far outside the triangle. Not sure where
  /// another of its lines, or rounding, may find the other answer: see docs/VALIDATION.md.
  Presence within(size_t triangle, const Corners& corners, const Beam& beam) const;
  /// The same of a line alone, and faster.
  bool there(size_t triangle, const Corners& corners, const glm::dvec3& point, const glm::dvec3& direction) const;

 private:
  static constexpr uint32_t opaque = std::numeric_limits<uint32_t>::max();

  struct Map {
    int width = 1, height = 1;
    std::vector<uint8_t> alpha;  ///< top row first
    Wrap wrap_u = Wrap::repeat, wrap_v = Wrap::repeat;
    bool nearest = false;

    double texel(int64_t x, int64_t y) const;
    double filtered(const glm::dvec2& at) const;
    /// Bounds of filtered() over the box around a point.
    std::pair<double, double> range(const glm::dvec2& at, const glm::dvec2& radius) const;
  };
  struct Mask {
    int map = -1;  ///< -1: alpha 1 everywhere
    double factor = 1.0, cutoff = 0.5;
    bool passes(double alpha) const;
    glm::dmat3 uv_transform{1.0};
  };
  struct Masked {
    uint32_t material = 0;
    glm::vec2 uv[3]{};
  };
  /// Where a line meets the triangle's plane, on the triangle's map.
  struct Hit {
    glm::dvec3 hit, normal, to_b, to_c;
    glm::dvec2 per_b, per_c, texel;
    double facing;
    bool known() const;
  };
  Hit locate(const Masked& its, const Map& map, const Corners& corners, const glm::dvec3& point,
             const glm::dvec3& direction) const;

  std::vector<Map> maps_;
  std::vector<Mask> masks_;  ///< one a material
  std::vector<uint32_t> entries_;
  std::vector<Masked> triangles_;
};

}  // namespace izb::reference
