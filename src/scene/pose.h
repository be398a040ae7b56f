// SPDX-License-Identifier: MIT
// Where a scene's nodes, skins, morph targets, lights and cameras stand at a moment (glTF 2.0, sections 3.5, 3.7 and
// 3.11), in double precision.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace izb {

/// A moment of a scene's animations.
struct AnimationMoment {
  std::string animation;  ///< name or index, several with semicolons between them, or "all"; empty: the scene's first
  double time_s = 0.0;
  bool loop = false;  ///< an animation begins again at its end
};

/// The animations so named. Throws izb::Error with the names there are, or with the fault of one that cannot be played.
std::vector<const Animation*> find_animations(const Scene& scene, const std::string& names);

/// The property at that time: a time before the first key is that key's, one after the last is the last's.
std::vector<double> value_at(const Track& track, double time_s);

/// World from node, one a node, of nodes as they stand in the list.
std::vector<glm::dmat4> world_from_nodes(const std::vector<Node>& nodes);

/// A camera's transform without scale or shear: -z keeps its direction, +y stays in the plane of both. Empty if the
/// axes leave it undefined.
std::optional<glm::dmat4> rigid(const glm::dmat4& world_from_node);

/// Poses a scene, at one moment after another: what stands in its nodes stays, what is as posed changes. The scene must
/// outlive it and keep its meshes.
class Poser {
 public:
  explicit Poser(Scene& scene);
  /// Nodes at rest, weights as in the file. Throws izb::Error with the cause alone: coordinates that single precision
  /// cannot hold.
  void at_rest();
  /// What the animations do not move is at rest. Throws also what find_animations() does.
  void at(const AnimationMoment& moment);
  /// Where its node is now; one without stays.
  void place(Camera& camera) const;
  void place(Light& light) const;

 private:
  void pose(const std::vector<Node>& nodes);
  void place(Instance& instance, const std::vector<Node>& nodes) const;
  void check(const glm::dmat4& world_from_mesh, const Instance& instance) const;

  Scene& scene_;
  std::vector<Bounds> bounds_;               ///< of each mesh at rest
  std::vector<glm::dmat4> world_from_node_;  ///< as posed
};

/// An instance's vertices as posed, in the space that its own matrix places: morph targets, then the skin. The
/// definition that the GPU's deformation is checked against.
std::vector<glm::dvec3> posed_positions(const Scene& scene, const Instance& instance);

/// The same in world space.
std::vector<glm::dvec3> posed_positions_ws(const Scene& scene, const Instance& instance);

}  // namespace izb
