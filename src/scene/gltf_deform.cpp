// SPDX-License-Identifier: MIT
#include "scene/gltf_deform.h"

#include <cmath>

#include "base/error.h"

namespace izb {
namespace {

struct Influence {
  uint16_t joint = 0;
  float weight = 0.0f;
};

std::vector<glm::vec3> target_attribute(const tinygltf::Model& model, const std::map<std::string, int>& target,
                                        const std::string& name, size_t t, const ElementRange& range) {
  const auto it = target.find(name);
  if (it == target.end()) return {};
  std::vector<glm::vec3> values = read_vec3(model, it->second, range);
  for (size_t i = 0; i < values.size(); ++i)
    if (!std::isfinite(values[i].x) || !std::isfinite(values[i].y) || !std::isfinite(values[i].z))
      fail("{} of vertex {} in morph target {} is not finite", name, range.first + i, t);
  return values;
}

/// The weights of one vertex with the sum 1.
void normalize(std::vector<Influence>& influences) {
  if (influences.empty()) influences.push_back({0, 1.0f});
  double sum = 0.0;
  for (const Influence& i : influences) sum += double(i.weight);
  for (Influence& i : influences) i.weight = static_cast<float>(double(i.weight) / sum);
}

}  // namespace

void load_morph_targets(const tinygltf::Model& model, const tinygltf::Primitive& primitive, const ElementRange& range,
                        Mesh& mesh) {
  for (size_t t = 0; t < primitive.targets.size(); ++t) {
    MorphTarget target;
    target.positions = target_attribute(model, primitive.targets[t], "POSITION", t, range);
    if (!mesh.normals.empty()) target.normals = target_attribute(model, primitive.targets[t], "NORMAL", t, range);
    mesh.targets.push_back(std::move(target));
  }
}

void load_influences(const tinygltf::Model& model, const tinygltf::Primitive& primitive, const ElementRange& range,
                     Mesh& mesh) {
  std::vector<std::vector<Influence>> of_vertex;
  for (int set = 0;; ++set) {
    const auto joints = primitive.attributes.find(fmt::format("JOINTS_{}", set));
    const auto weights = primitive.attributes.find(fmt::format("WEIGHTS_{}", set));
    if (joints == primitive.attributes.end() || weights == primitive.attributes.end()) break;
    of_vertex.resize(mesh.positions.size());
    const std::vector<glm::uvec4> ids = read_uvec4(model, joints->second, range);
    const std::vector<glm::vec4> values = read_vec4(model, weights->second, range);
    for (size_t i = 0; i < of_vertex.size(); ++i)
      for (int k = 0; k < 4; ++k) {
        const float weight = values[i][k];
        if (!(weight >= 0.0f && weight <= 1.0e6f))
          fail("the joint weight of vertex {} is {}, not a share", range.first + i, weight);
        if (weight == 0.0f) continue;
        if (ids[i][k] > 0xffffu) fail("joint {} of vertex {} is out of range", ids[i][k], range.first + i);
        of_vertex[i].push_back({static_cast<uint16_t>(ids[i][k]), weight});
      }
  }
  for (std::vector<Influence>& influences : of_vertex) {
    normalize(influences);
    mesh.influences = std::max(mesh.influences, static_cast<uint32_t>(influences.size()));
  }
  for (const std::vector<Influence>& influences : of_vertex)
    for (size_t k = 0; k < mesh.influences; ++k) {
      const Influence i = k < influences.size() ? influences[k] : Influence{};
      mesh.joints.push_back(i.joint);
      mesh.weights.push_back(i.weight);
    }
}

}  // namespace izb
