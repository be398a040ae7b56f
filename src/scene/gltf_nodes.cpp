// SPDX-License-Identifier: MIT
#include "scene/gltf_nodes.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "scene/pose.h"

namespace izb {
namespace {

bool finite(const glm::dmat4& m) {
  for (int c = 0; c < 4; ++c)
    for (int r = 0; r < 4; ++r)
      if (!std::isfinite(m[c][r])) return false;
  return true;
}

Node load_node(const tinygltf::Model& model, size_t index) {
  const tinygltf::Node& source = model.nodes[index];
  Node node;
  node.name = source.name.empty() ? fmt::format("node {}", index) : source.name;
  if (!source.matrix.empty()) {
    glm::dmat4& m = node.matrix.emplace();
    for (int c = 0; c < 4; ++c)
      for (int r = 0; r < 4; ++r) m[c][r] = source.matrix[static_cast<size_t>(4 * c + r)];
    constexpr double tolerance = 1e-5;
    for (int c = 0; c < 4; ++c) {
      const double expected = c == 3 ? 1.0 : 0.0;
      if (std::abs(m[c][3] - expected) > tolerance) fail("the matrix of nodes[{}] is not affine", index);
      m[c][3] = expected;
    }
  }
  if (!source.scale.empty()) node.scale = {source.scale[0], source.scale[1], source.scale[2]};
  if (!source.rotation.empty()) {
    const glm::dquat q(source.rotation[3], source.rotation[0], source.rotation[1], source.rotation[2]);
    const double length = glm::length(q);
    if (!(length > 0.0)) fail("the rotation of nodes[{}] has no length", index);
    node.rotation = q / length;
  }
  if (!source.translation.empty())
    node.translation = {source.translation[0], source.translation[1], source.translation[2]};
  node.morph_weights = source.weights;
  if (source.mesh >= 0 && source.weights.empty())
    node.morph_weights = model.meshes[static_cast<size_t>(source.mesh)].weights;
  return node;
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

NodeHierarchy load_nodes(const tinygltf::Model& model, Scene& scene) {
  const std::vector<int> parents = find_parents(model);
  std::vector<int> all_roots;
  for (size_t i = 0; i < parents.size(); ++i)
    if (parents[i] < 0) all_roots.push_back(static_cast<int>(i));

  NodeHierarchy result;
  result.scene_index.assign(model.nodes.size(), -1);
  const std::vector<int> order = collect(model, all_roots);
  for (const int i : order) {
    const auto node = static_cast<size_t>(i);
    result.scene_index[node] = static_cast<int>(scene.nodes.size());
    scene.nodes.push_back(load_node(model, node));
    if (parents[node] >= 0) scene.nodes.back().parent = result.scene_index[static_cast<size_t>(parents[node])];
  }
  for (size_t i = 0; i < model.nodes.size(); ++i)
    if (result.scene_index[i] < 0) fail("nodes[{}] is part of, or below, a cycle of nodes", i);
  const std::vector<glm::dmat4> world_from_node = world_from_nodes(scene.nodes);
  for (size_t k = 0; k < order.size(); ++k)
    if (!finite(world_from_node[k])) fail("the transform of nodes[{}] is not finite", order[k]);
  result.in_scene = collect(model, scene_roots(model, all_roots));
  return result;
}

}  // namespace izb
