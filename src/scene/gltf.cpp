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
#include "scene/pose.h"

namespace izb {
namespace {

void load_skins(const tinygltf::Model& model, const NodeHierarchy& nodes, Scene& scene) {
  for (size_t i = 0; i < model.skins.size(); ++i) {
    const tinygltf::Skin& source = model.skins[i];
    if (source.joints.empty()) fail("skins[{}] has no joint", i);
    Skin skin;
    for (const int joint : source.joints)
      skin.joints.push_back(static_cast<uint32_t>(nodes.scene_index[static_cast<size_t>(joint)]));
    skin.joint_from_bind.assign(skin.joints.size(), glm::dmat4(1.0));
    if (source.inverseBindMatrices >= 0) {
      const std::vector<glm::mat4> inverse_binds = read_mat4(model, source.inverseBindMatrices);
      if (inverse_binds.size() < skin.joints.size())
        fail("skins[{}] has {} joints, but only {} inverse bind matrices", i, skin.joints.size(), inverse_binds.size());
      std::copy_n(inverse_binds.begin(), skin.joints.size(), skin.joint_from_bind.begin());
    }
    scene.skins.push_back(std::move(skin));
  }
}

/// Of the time that loading takes, about.
constexpr double share_of_reading = 0.5;

/// Turns the nodes' meshes into meshes and instances. A primitive is loaded once, however many nodes show it.
class InstanceLoader {
 public:
  InstanceLoader(const tinygltf::Model& model, const NodeHierarchy& nodes, bool stays, const LoadProgress& progress,
                 Scene& scene)
      : model_(model), nodes_(nodes), stays_(stays), progress_(progress), scene_(scene) {}

  void run() {
    for (size_t k = 0; k < nodes_.in_scene.size(); ++k) {
      const auto node = static_cast<size_t>(nodes_.in_scene[k]);
      if (model_.nodes[node].mesh >= 0) add_node(node);
      report(double(k + 1) / double(nodes_.in_scene.size()));
    }
    tally_.describe(scene_.ignored, stays_);
    if (scene_.triangle_count() == 0)
      fail("its scene holds no triangle{}",
           tally_.point_primitives + tally_.line_primitives > 0 ? ", only points or lines" : "");
  }

 private:
  static constexpr int no_mesh = -1;

  void report(double share) const {
    if (progress_) progress_(share_of_reading + (1.0 - share_of_reading) * share);
  }

  void add_node(size_t node_index) {
    const tinygltf::Node& node = model_.nodes[node_index];
    const tinygltf::Mesh& mesh = model_.meshes[static_cast<size_t>(node.mesh)];
    for (size_t p = 0; p < mesh.primitives.size(); ++p) {
      const int index = shared_mesh(node.mesh, static_cast<int>(p));
      if (index != no_mesh) add_instance(static_cast<uint32_t>(index), node.skin, node_index);
    }
  }

  int shared_mesh(int mesh, int primitive) {
    const auto [it, is_new] = shared_.try_emplace({mesh, primitive}, no_mesh);
    if (is_new)
      if (std::optional<Mesh> loaded = load_primitive(model_, mesh, primitive, tally_)) {
        it->second = static_cast<int>(scene_.meshes.size());
        scene_.meshes.push_back(std::move(*loaded));
      }
    return it->second;
  }

  void add_instance(uint32_t mesh_index, int skin, size_t node_index) {
    const Mesh& mesh = scene_.meshes[mesh_index];
    Instance instance;
    instance.mesh = mesh_index;
    instance.node = nodes_.scene_index[node_index];
    instance.morph_weights.resize(mesh.targets.size());
    tally_.morphed_primitives += !mesh.targets.empty();
    if (skin >= 0 && mesh.influences > 0) {
      instance.skin = skin;
      ++tally_.skinned_primitives;
      const size_t joints = scene_.skins[static_cast<size_t>(skin)].joints.size();
      const uint16_t last = *std::max_element(mesh.joints.begin(), mesh.joints.end());
      if (last >= joints)
        fail("nodes[{}]: joint {} of a vertex is out of range (skins[{}] has {} joints)", node_index, last, skin,
             joints);
    }
    scene_.instances.push_back(std::move(instance));
  }

  const tinygltf::Model& model_;
  const NodeHierarchy& nodes_;
  const bool stays_;
  const LoadProgress& progress_;
  Scene& scene_;
  MeshTally tally_;
  std::map<std::pair<int, int>, int> shared_;  ///< mesh and primitive of the file → mesh of the scene
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

Scene load(const std::filesystem::path& path, bool stays, const LoadProgress& progress) {
  tinygltf::Model model = read_gltf_document(path, [&](double share) {
    if (progress) progress(0.5 * share_of_reading * share);  // the other half is parsing
  });
  if (progress) progress(share_of_reading);
  Scene scene;
  scene.name = path.stem().string();
  const NodeHierarchy nodes = load_nodes(model, scene);
  load_materials(model, scene);
  load_animations(model, nodes, scene);
  load_skins(model, nodes, scene);
  InstanceLoader(model, nodes, stays, progress, scene).run();
  add_default_material(scene);
  load_cameras(model, nodes, scene);
  load_lights(model, nodes, scene);
  describe_extensions(model, scene);
  if (stays && !scene.animations.empty())
    scene.ignored.push_back(fmt::format("animations: {}, none is played (--time and --animation choose a moment)",
                                        scene.animations.size()));
  Poser(scene).at_rest();
  return scene;
}

}  // namespace

Scene load_gltf(const std::filesystem::path& path, bool stays, const LoadProgress& progress) {
  try {
    return load(path, stays, progress);
  } catch (const Error& e) {
    fail("cannot load '{}': {}", path.string(), e.what());
  } catch (const std::bad_alloc&) {
    fail("cannot load '{}': it needs more memory than there is", path.string());
  } catch (const std::exception& e) {
    fail("cannot load '{}': {}", path.string(), e.what());
  }
}

}  // namespace izb
