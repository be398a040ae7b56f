// SPDX-License-Identifier: MIT
// What the procedural scenes are built with. A scene is built at a level of detail that gives it the number of
// triangles asked for: first by rounds that only count, then once for real (fit.h).
#pragma once
#include <deque>
#include <glm/glm.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "scene/procedural/pen.h"
#include "scene/random.h"
#include "scene/scene.h"

namespace izb::procedural {

constexpr double degree = std::numbers::pi / 180.0;

/// Where a camera stands and what it looks at.
struct View {
  glm::dvec3 eye, target;
};

class Builder {
 public:
  /// `detail` is 1 at the scene's default number of triangles; twice the detail halves the edges. A counting builder
  /// keeps no geometry.
  Builder(const char* name, uint32_t seed, double detail, bool counting);

  bool counting() const { return counting_; }
  double detail() const { return detail_; }
  size_t triangle_count() const;

  /// Random numbers of their own for each thing, so that what one thing draws moves no other.
  Random random(uint64_t stream) const { return Random{seed_ ^ (stream * 0xd1342543de82ef95ull)}; }

  /// Level of detail. All but the first round to either side by turns, so that numbers grow evenly with detail.
  double at_detail(double at_default) const { return at_default * detail_; }
  int pieces(double at_default, int least);  ///< of something that is cut finer with detail
  int rounded(double number, int least);
  int flat_pieces(double size_m);  ///< of a flat face's edge: one, until detail exceeds 1
  bool keeps(double from_detail);  ///< whether a part shows that belongs to such a detail or finer
  void set_flat_edge_m(double edge_m) { flat_edge_m_ = edge_m; }  ///< of flat faces at detail 2

  uint32_t material(const char* name, const glm::vec3& color, bool double_sided = false);

  /// Draws what stands once in the world, in the space that `world_from_pen` places.
  Pen pen(uint32_t material, const glm::dmat4& world_from_pen = glm::dmat4{1.0});

  /// Draws a mesh of its own, which place() puts into the world as often as wanted.
  Pen part(const char* name, uint32_t material);
  void place(const Pen& part, const glm::dmat4& world_from_part);

  void camera(const char* name, const View& view, double yfov_deg);
  /// The animated camera "path": through `stops`, smoothly, in `length_s`; a closed path ends where it begins.
  void path(const std::vector<View>& stops, double length_s, bool closed, double yfov_deg);
  void sun(const char* name, double azimuth_deg, double elevation_deg, const glm::vec3& color, float intensity);

  /// For what the functions above do not make: skins, joints, other lights. The path, if any, is node 0 by then.
  Scene& scene() { return scene_; }
  /// Counts what a scene adds by itself.
  void add_count(size_t triangles) { added_ += triangles; }

  Scene finish();

 private:
  friend class Pen;
  double next_dither();

  Scene scene_;
  uint64_t seed_;
  double detail_;
  bool counting_;
  double flat_edge_m_ = 0.5;
  double dither_ = 0.5;
  size_t placed_ = 0, added_ = 0;
  std::deque<Batch> batches_;
};

/// Direction to what stands there: azimuth clockwise from north (-z) seen from above.
glm::dvec3 towards(double azimuth_deg, double elevation_deg);

glm::dmat4 translated(const glm::dvec3& by);
glm::dmat4 turned(int axis, double angle_deg);  ///< about x (0), y (1) or z (2)
glm::dmat4 at(const glm::dvec3& position, double turn_deg = 0.0);
/// With y along `up` at `position`, and x and z somewhere across.
glm::dmat4 along(const glm::dvec3& position, const glm::dvec3& up);
glm::dmat4 looking(const View& view);

/// A unit vector across `direction`.
glm::dvec3 across(const glm::dvec3& direction);

inline double smooth_step(double low, double high, double x) {
  const double t = glm::clamp((x - low) / (high - low), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

}  // namespace izb::procedural
