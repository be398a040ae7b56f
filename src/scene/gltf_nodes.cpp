// SPDX-License-Identifier: MIT
#include "scene/gltf_nodes.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>

#include "base/error.h"

namespace izb {
namespace {

bool finite(const glm::dmat4& m) {
  for (int c = 0; c < 4; ++c)
    for (int r = 0; r < 4; ++r)
      if (!std::isfinite(m[c][r])) return false;
  return true;
}

glm::dmat4 parent_from_node(const tinygltf::Node& node, size_t index) {
  glm::dmat4 m(1.0);
  if (!node.matrix.empty()) {
    for (int c = 0; c < 4; ++c)
      for (int r = 0; r < 4; ++r) m[c][r] = node.matrix[static_cast<size_t>(4 * c + r)];
    constexpr double tolerance = 1e-5;
    for (int c = 0; c < 4; ++c) {
      const double expected = c == 3 ? 1.0 : 0.0;
      if (std::abs(m[c][3] - expected) > tolerance) fail("the matrix of nodes[{}] is not affine", index);
      m[c][3] = expected;
    }
    return m;
  }
  if (!node.scale.empty())
    for (int c = 0; c < 3; ++c) m[c][c] = node.scale[static_cast<size_t>(c)];
  if (!node.rotation.empty()) {
    const glm::dquat q(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]);
    const double length = glm::length(q);
    if (!(length > 0.0)) fail("the rotation of nodes[{}] has no length", index);
    m = glm::mat4_cast(q / length) * m;
  }
  if (!node.translation.empty()) m[3] = glm::dvec4(node.translation[0], node.translation[1], node.translation[2], 1.0);
  return m;
}

std::vector<int> find_parents(const tinygltf::Model& model) {
  std::vector<int> parents(model.nodes.size(), -1);
  for (size_t i = 0; i < model.nodes.size(); ++i)
    for (const int child : model.nodes[i].children) {
      int& parent = parents[static_cast<size_t>(child)];
      if (parent >= 0)
        fail("nodes[{}] is a child twice (of nodes[{}] and nodes[{}]), so the nodes are no tree", child, parent, i);
      parent = static_cast<int>(i);
    }
  return parents;
}

const std::vector<int>& scene_roots(const tinygltf::Model& model, const std::vector<int>& all_roots) {
  if (model.scenes.empty()) return all_roots;
  return model.scenes[static_cast<size_t>(std::max(model.defaultScene, 0))].nodes;
}

/// All nodes below `roots`, parents before children, each once.
std::vector<int> collect(const tinygltf::Model& model, const std::vector<int>& roots) {
  std::vector<int> order;
  std::vector<bool> seen(model.nodes.size(), false);
  const auto add = [&](int node) {
    if (seen[static_cast<size_t>(node)]) return;
    seen[static_cast<size_t>(node)] = true;
    order.push_back(node);
  };
  for (const int root : roots) add(root);
  for (size_t i = 0; i < order.size(); ++i)
    for (const int child : model.nodes[static_cast<size_t>(order[i])].children) add(child);
  return order;
}

}  // namespace

NodeHierarchy flatten_nodes(const tinygltf::Model& model) {
  const std::vector<int> parents = find_parents(model);
  std::vector<int> all_roots;
  for (size_t i = 0; i < parents.size(); ++i)
    if (parents[i] < 0) all_roots.push_back(static_cast<int>(i));

  NodeHierarchy result;
  result.world_from_node.resize(model.nodes.size());
  const std::vector<int> order = collect(model, all_roots);
  if (order.size() < model.nodes.size()) {
    std::vector<bool> reached(model.nodes.size(), false);
    for (const int i : order) reached[static_cast<size_t>(i)] = true;
    for (size_t i = 0; i < reached.size(); ++i)
      if (!reached[i]) fail("nodes[{}] is part of, or below, a cycle of nodes", i);
  }
  for (const int i : order) {
    const auto node = static_cast<size_t>(i);
    const glm::dmat4 local = parent_from_node(model.nodes[node], node);
    const int parent = parents[node];
    glm::dmat4& world = result.world_from_node[node];
    world = parent < 0 ? local : result.world_from_node[static_cast<size_t>(parent)] * local;
    if (!finite(world)) fail("the transform of nodes[{}] is not finite", i);
  }
  result.in_scene = collect(model, scene_roots(model, all_roots));
  return result;
}

}  // namespace izb
