// SPDX-License-Identifier: MIT
#include "scene/procedural/rig.h"

#include <algorithm>
#include <utility>

#include "scene/portable_math.h"

namespace izb::procedural {

using glm::dquat;
using glm::dvec3;

uint32_t add_node(Scene& scene, const char* name, int parent, const dvec3& translation) {
  Node node;
  node.name = name;
  node.parent = parent;
  node.translation = translation;
  scene.nodes.push_back(node);
  return uint32_t(scene.nodes.size() - 1);
}

int add_skin(Scene& scene, const std::vector<uint32_t>& joints) {
  Skin skin;
  skin.joints = joints;
  for (const uint32_t joint : joints) {
    dvec3 at{0.0};  // at rest no joint is turned
    for (int node = int(joint); node >= 0; node = scene.nodes[size_t(node)].parent)
      at += scene.nodes[size_t(node)].translation;
    skin.joint_from_bind.push_back(translated(-at));
    skin.world_from_bind.emplace_back(1.0);
  }
  scene.skins.push_back(std::move(skin));
  return int(scene.skins.size() - 1);
}

void add_skinned(Scene& scene, Mesh mesh, const std::vector<Influence>& influences, int skin) {
  mesh.influences = 4;
  for (const Influence& influence : influences) {
    mesh.joints.insert(mesh.joints.end(), influence.joints.begin(), influence.joints.end());
    mesh.weights.insert(mesh.weights.end(), influence.weights.begin(), influence.weights.end());
  }
  scene.meshes.push_back(std::move(mesh));
  Instance instance;
  instance.mesh = uint32_t(scene.meshes.size() - 1);
  instance.skin = skin;
  scene.instances.push_back(std::move(instance));
}

dquat about(const dvec3& axis, double angle) {
  const glm::dvec2 on = on_circle(0.5 * angle);
  return {on.x, on.y * axis.x, on.y * axis.y, on.y * axis.z};
}

namespace {

Track track(uint32_t node, AnimatedProperty property, double length_s, int keys) {
  Track out;
  out.node = node;
  out.property = property;
  for (int k = 0; k <= keys; ++k) out.times_s.push_back(float(length_s * k / keys));
  return out;
}

}  // namespace

Track rotation_track(uint32_t node, double length_s, int keys, const std::vector<dquat>& values) {
  Track out = track(node, AnimatedProperty::rotation, length_s, keys);
  dquat last = values.front();
  for (dquat q : values) {
    if (glm::dot(q, last) < 0.0) q = -q;
    last = q;
    for (const double v : {q.x, q.y, q.z, q.w}) out.values.push_back(float(v));
  }
  return out;
}

Track translation_track(uint32_t node, double length_s, int keys, const std::vector<dvec3>& values) {
  Track out = track(node, AnimatedProperty::translation, length_s, keys);
  for (const dvec3& p : values)
    for (const double v : {p.x, p.y, p.z}) out.values.push_back(float(v));
  return out;
}

void add_motion(Scene& scene, const char* name, std::vector<Track> tracks, double length_s) {
  Animation motion;
  motion.name = name;
  motion.length_s = length_s;
  motion.tracks = std::move(tracks);
  scene.animations.insert(scene.animations.begin(), std::move(motion));
}

}  // namespace izb::procedural
