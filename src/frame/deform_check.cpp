// SPDX-License-Identifier: MIT
#include "frame/deform_check.h"

#include <algorithm>
#include <cmath>

#include "scene/pose.h"

namespace izb {
namespace {

/// For one vertex, in the space that the instance's own matrix places, a bound for each axis.
glm::dvec3 rounding_of(const Mesh& mesh, const Instance& instance, const std::vector<glm::dmat4>& object_from_bind,
                       size_t vertex) {
  constexpr double u = 0x1p-24 * 1.01;  // and the squares of it
  glm::dvec3 size = glm::abs(glm::dvec3(mesh.positions[vertex]));
  for (size_t t = 0; t < instance.morph_weights.size(); ++t)
    if (!mesh.targets[t].positions.empty())
      size += glm::abs(double(instance.morph_weights[t]) * glm::dvec3(mesh.targets[t].positions[vertex]));
  const double morphs = double(instance.morph_weights.size()) + 1.0;
  if (instance.skin < 0) return morphs * u * size;
  glm::dvec3 morphed(0.0), whole(0.0);
  for (size_t k = vertex * mesh.influences; k < (vertex + 1) * mesh.influences; ++k) {
    const glm::dmat4& joint = object_from_bind[mesh.joints[k]];
    const double weight = std::abs(double(mesh.weights[k]));
    for (int axis = 0; axis < 3; ++axis) {
      double turned = 0.0;
      for (int c = 0; c < 3; ++c) turned += std::abs(joint[c][axis]) * size[c];
      morphed[axis] += weight * turned;
      whole[axis] += weight * (turned + std::abs(joint[3][axis]));
    }
  }
  return u * (morphs * morphed + (double(mesh.influences) + 6.0) * whole);
}

/// The part of `error` that the bound does not explain is above 1.
double in_bounds(const glm::dvec3& error, const glm::dvec3& bound) {
  double largest = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    if (!std::isfinite(error[axis])) return HUGE_VAL;
    if (error[axis] != 0.0) largest = std::max(largest, std::abs(error[axis]) / bound[axis]);
  }
  return largest;
}

}  // namespace

DeformCheck check_deformation(const Scene& scene, const SceneBuffers& buffers) {
  DeformCheck check;
  const DrawList& list = buffers.draw_list();
  for (const DrawPart& part : list.parts) {
    const Instance& instance = scene.instances[part.instance];
    if (!instance.deforms() || part.mesh_triangle > 0) continue;
    const Mesh& mesh = scene.meshes[instance.mesh];
    const glm::dmat4 object_from_world = glm::inverse(instance.world_from_object);
    std::vector<glm::dmat4> object_from_bind;
    if (instance.skin >= 0)
      for (const glm::dmat4& m : scene.skins[static_cast<size_t>(instance.skin)].world_from_bind)
        object_from_bind.push_back(object_from_world * m);
    std::vector<glm::vec3> found(mesh.positions.size());
    buffers.positions().read_bytes(part.base_vertex * sizeof(glm::vec3), found.size() * sizeof(glm::vec3),
                                   found.data());
    const std::vector<glm::vec3> on_cpu = deformed_positions(scene, instance);
    const std::vector<glm::dvec3> expected = posed_positions(scene, instance);
    for (size_t v = 0; v < found.size(); ++v) {
      const double error =
          in_bounds(glm::dvec3(found[v]) - expected[v], rounding_of(mesh, instance, object_from_bind, v));
      check.largest_error = std::max(check.largest_error, error);
      check.wrong += error > 1.0;
      check.not_as_on_cpu += found[v] != on_cpu[v];
    }
    check.vertices += found.size();
  }
  return check;
}

}  // namespace izb
