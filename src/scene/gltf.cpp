// SPDX-License-Identifier: MIT
#include "scene/gltf.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <new>
#include <span>
#include <utility>

#include "base/error.h"
#include "scene/gltf_accessor.h"
#include "scene/gltf_animation.h"
#include "scene/gltf_check.h"
#include "scene/gltf_document.h"
#include "scene/gltf_material.h"
#include "scene/gltf_mesh.h"
#include "scene/gltf_nodes.h"
#include "scene/gltf_punctual.h"

namespace izb {
namespace {

/// Joint matrices with every joint at rest (glTF 2.0, section 3.7.3.1): world from joint * joint from bind.
std::vector<glm::dmat4> joints_at_rest(const tinygltf::Model& model, int skin_index, const NodeHierarchy& nodes) {
  const tinygltf::Skin& skin = model.skins[static_cast<size_t>(skin_index)];
  std::vector<glm::dmat4> joints(skin.joints.size(), glm::dmat4(1.0));
  if (skin.inverseBindMatrices >= 0) {
    const std::vector<glm::mat4> inverse_binds = read_mat4(model, skin.inverseBindMatrices);
    if (inverse_binds.size() < joints.size())
      fail("skins[{}] has {} joints, but only {} inverse bind matrices", skin_index, joints.size(),
           inverse_binds.size());
    for (size_t j = 0; j < joints.size(); ++j) joints[j] = glm::dmat4(inverse_binds[j]);
  }
  for (size_t j = 0; j < joints.size(); ++j)
    joints[j] = nodes.world_from_node[static_cast<size_t>(skin.joints[j])] * joints[j];
  return joints;
}

/// Turns the nodes' meshes into meshes and instances. A primitive is loaded once, however many nodes show it,
/// unless a node poses it by a skin or by morph weights of its own.
class InstanceLoader {
 public:
  InstanceLoader(const tinygltf::Model& model, const NodeHierarchy& nodes, bool at_rest, Scene& scene)
      : model_(model), nodes_(nodes), at_rest_(at_rest), scene_(scene) {}

  void run() {
    for (const int i : nodes_.in_scene)
      if (model_.nodes[static_cast<size_t>(i)].mesh >= 0) add_node(static_cast<size_t>(i));
    tally_.describe(scene_.ignored, at_rest_);
    if (scene_.triangle_count() == 0)
      fail("its scene holds no triangle{}",
           tally_.point_primitives + tally_.line_primitives > 0 ? ", only points or lines" : "");
  }

 private:
  static constexpr int no_mesh = -1;
  /// Products of two edges and a square of that stay below the largest float at the scale of such a scene's parts.
  static constexpr float largest_coordinate = 1.0e15f;

  void add_node(size_t node_index) {
    const tinygltf::Node& node = model_.nodes[node_index];
    const tinygltf::Mesh& mesh = model_.meshes[static_cast<size_t>(node.mesh)];
    std::vector<glm::dmat4> joints;
    if (node.skin >= 0) joints = joints_at_rest(model_, node.skin, nodes_);
    for (size_t p = 0; p < mesh.primitives.size(); ++p) {
      const auto& attributes = mesh.primitives[p].attributes;
      const bool skinned = !joints.empty() && attributes.contains("JOINTS_0") && attributes.contains("WEIGHTS_0");
      PrimitiveSource source{node.mesh, static_cast<int>(p), mesh.weights, {}};
      if (!node.weights.empty()) source.morph_weights = node.weights;
      if (skinned) source.world_from_bind_joints = joints;
      const bool shared = !skinned && node.weights.empty();
      const int index = shared ? shared_mesh(source) : add_mesh(source);
      if (index == no_mesh) continue;
      // A skin places its mesh in the world by itself: the node's own transform has no effect.
      add_instance(index, skinned ? glm::dmat4(1.0) : nodes_.world_from_node[node_index], node_index);
    }
  }

  int shared_mesh(const PrimitiveSource& source) {
    const auto [it, is_new] = shared_.try_emplace({source.mesh, source.primitive}, no_mesh);
    if (is_new) it->second = add_mesh(source);
    return it->second;
  }

  int add_mesh(const PrimitiveSource& source) {
    std::optional<Mesh> mesh = load_primitive(model_, source, tally_);
    if (!mesh) return no_mesh;
    Bounds bounds;
    for (const glm::vec3& p : mesh->positions) bounds.add(glm::dvec3(p));
    bounds_.push_back(bounds);
    scene_.meshes.push_back(std::move(*mesh));
    return static_cast<int>(scene_.meshes.size() - 1);
  }

  void add_instance(int mesh, const glm::dmat4& world_from_object, size_t node_index) {
    const Bounds& bounds = bounds_[static_cast<size_t>(mesh)];
    for (int corner = 0; corner < 8; ++corner) {
      const glm::dvec3 p((corner & 1) ? bounds.max.x : bounds.min.x, (corner & 2) ? bounds.max.y : bounds.min.y,
                         (corner & 4) ? bounds.max.z : bounds.min.z);
      const glm::vec3 world(world_from_object * glm::dvec4(p, 1.0));
      if (!std::isfinite(world.x) || !std::isfinite(world.y) || !std::isfinite(world.z))
        fail("nodes[{}] moves its mesh out of the range of floating-point numbers", node_index);
      const float size = std::max({std::abs(world.x), std::abs(world.y), std::abs(world.z)});
      if (size > largest_coordinate)
        fail("nodes[{}] has coordinates of {:.3g} units, and single precision copes with at most {:.0e}", node_index,
             size, largest_coordinate);
    }
    scene_.instances.push_back({static_cast<uint32_t>(mesh), world_from_object});
  }

  const tinygltf::Model& model_;
  const NodeHierarchy& nodes_;
  const bool at_rest_;
  Scene& scene_;
  MeshTally tally_;
  std::map<std::pair<int, int>, int> shared_;  ///< mesh and primitive of the file → mesh of the scene
  std::vector<Bounds> bounds_;                 ///< one a mesh of the scene, object space
};

/// Meshes without a material refer to the one behind the file's own.
void add_default_material(Scene& scene) {
  bool used = scene.materials.empty();
  for (const Mesh& mesh : scene.meshes) used = used || mesh.material == scene.materials.size();
  if (!used) return;
  Material material;
  material.name = "default";
  scene.materials.push_back(material);
}

void describe_extensions(const tinygltf::Model& model, Scene& scene) {
  for (const std::string& name : model.extensionsUsed) {
    if (gltf_extension_is_supported(name) || name == "KHR_materials_unlit") continue;
    scene.ignored.push_back(name == "EXT_mesh_gpu_instancing"
                                ? fmt::format("the extension {} is ignored: each mesh is shown once a node", name)
                                : fmt::format("the extension {} is ignored", name));
  }
}

Scene load(const std::filesystem::path& path, const std::optional<AnimationMoment>& moment) {
  tinygltf::Model model = read_gltf_document(path);
  if (moment) pose_nodes(model, *moment);
  const NodeHierarchy nodes = flatten_nodes(model);
  Scene scene;
  scene.name = path.stem().string();
  load_materials(model, scene);
  scene.animations = describe_animations(model);
  InstanceLoader(model, nodes, !moment, scene).run();
  add_default_material(scene);
  load_cameras(model, nodes, scene);
  load_lights(model, nodes, scene);
  describe_extensions(model, scene);
  if (!moment && !scene.animations.empty())
    scene.ignored.push_back(fmt::format("animations: {}, none is played (--time and --animation choose a moment)",
                                        scene.animations.size()));
  return scene;
}

}  // namespace

Scene load_gltf(const std::filesystem::path& path, const std::optional<AnimationMoment>& moment) {
  try {
    return load(path, moment);
  } catch (const Error& e) {
    fail("cannot load '{}': {}", path.string(), e.what());
  } catch (const std::bad_alloc&) {
    fail("cannot load '{}': it needs more memory than there is", path.string());
  } catch (const std::exception& e) {
    fail("cannot load '{}': {}", path.string(), e.what());
  }
}

}  // namespace izb
