// SPDX-License-Identifier: MIT
#include "scene/pose.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "scene/find.h"

namespace izb {
namespace {

/// Products of two edges and a square of that stay below the largest float at the scale of such a scene's parts.
constexpr double largest_coordinate = 1.0e15;

size_t width_of(const Track& track) {
  return track.values.size() / track.times_s.size() / (track.interpolation == Interpolation::cubic_spline ? 3 : 1);
}

/// Part 0 to 2 of a spline's key; others have part 1 alone.
const float* key_of(const Track& track, size_t k, size_t part = 1) {
  const size_t width = width_of(track);
  return &track.values[track.interpolation == Interpolation::cubic_spline ? (3 * k + part) * width : k * width];
}

glm::dquat unit_quaternion(double x, double y, double z, double w) {
  const glm::dquat q(w, x, y, z);
  const double length = glm::length(q);
  return length > 0.0 ? q / length : glm::dquat(1.0, 0.0, 0.0, 0.0);
}

std::vector<double> between(const Track& track, size_t k, double time_s) {
  const double length_s = double(track.times_s[k + 1]) - double(track.times_s[k]);
  const double u = (time_s - double(track.times_s[k])) / length_s;
  const float* const a = key_of(track, k);
  std::vector<double> out(a, a + width_of(track));
  if (track.interpolation == Interpolation::step) return out;
  const float* const b = key_of(track, k + 1);
  if (track.interpolation == Interpolation::linear) {
    if (track.property == AnimatedProperty::rotation) {
      const auto quaternion = [](const float* q) { return unit_quaternion(q[0], q[1], q[2], q[3]); };
      const glm::dquat q = glm::slerp(quaternion(a), quaternion(b), u);
      return {q.x, q.y, q.z, q.w};
    }
    for (size_t i = 0; i < out.size(); ++i) out[i] = (1.0 - u) * double(a[i]) + u * double(b[i]);
    return out;
  }
  const float* const leaving = key_of(track, k, 2);
  const float* const arriving = key_of(track, k + 1, 0);
  const double u2 = u * u, u3 = u2 * u;
  for (size_t i = 0; i < out.size(); ++i)
    out[i] = (2.0 * u3 - 3.0 * u2 + 1.0) * double(a[i]) + length_s * (u3 - 2.0 * u2 + u) * double(leaving[i]) +
             (3.0 * u2 - 2.0 * u3) * double(b[i]) + length_s * (u3 - u2) * double(arriving[i]);
  return out;
}

glm::dmat4 parent_from_node(const Node& node) {
  if (node.matrix) return *node.matrix;
  glm::dmat4 m = glm::mat4_cast(node.rotation);
  for (int c = 0; c < 3; ++c) m[c] *= node.scale[c];
  m[3] = glm::dvec4(node.translation, 1.0);
  return m;
}

void apply(const Track& track, double time_s, Node& node) {
  const std::vector<double> v = value_at(track, time_s);
  switch (track.property) {
    case AnimatedProperty::translation:
      node.translation = {v[0], v[1], v[2]};
      break;
    case AnimatedProperty::rotation:
      node.rotation = unit_quaternion(v[0], v[1], v[2], v[3]);
      break;
    case AnimatedProperty::scale:
      node.scale = {v[0], v[1], v[2]};
      break;
    case AnimatedProperty::morph_weights:
      node.morph_weights = v;
      break;
  }
}

}  // namespace

std::vector<const Animation*> find_animations(const Scene& scene, const std::string& names) {
  if (scene.animations.empty()) fail("it has no animation");
  std::vector<const Animation*> found;
  const auto add = [&](const std::string& name) {
    const Animation* const one = find_by_name_or_index(scene.animations, name);
    if (!one) fail("it has no animation '{}'; there are {}", name, names_of(scene.animations));
    found.push_back(one);
  };
  const auto is_one = [&] { return find_by_name_or_index(scene.animations, names) != nullptr; };
  if (names.empty())
    found.push_back(&scene.animations.front());
  else if (names == "all" && !is_one())
    for (const Animation& animation : scene.animations) found.push_back(&animation);
  else if (is_one())
    add(names);
  else
    for (const std::string& name : list_of(names)) add(name);
  for (const Animation* const animation : found)
    if (!animation->fault.empty()) fail("{}", animation->fault);
  return found;
}

std::vector<double> value_at(const Track& track, double time_s) {
  const size_t last = track.times_s.size() - 1;
  const auto key = [&](size_t k) { return std::vector<double>(key_of(track, k), key_of(track, k) + width_of(track)); };
  if (last == 0 || time_s <= double(track.times_s.front())) return key(0);
  if (time_s >= double(track.times_s[last])) return key(last);
  const auto next = std::upper_bound(track.times_s.begin(), track.times_s.end(), time_s,
                                     [](double t, float key_time_s) { return t < double(key_time_s); });
  return between(track, static_cast<size_t>(next - track.times_s.begin()) - 1, time_s);
}

std::vector<glm::dmat4> world_from_nodes(const std::vector<Node>& nodes) {
  std::vector<glm::dmat4> world(nodes.size());
  for (size_t i = 0; i < nodes.size(); ++i) {
    world[i] = parent_from_node(nodes[i]);
    if (nodes[i].parent >= 0) world[i] = world[static_cast<size_t>(nodes[i].parent)] * world[i];
  }
  return world;
}

std::optional<glm::dmat4> rigid(const glm::dmat4& m) {
  const double z_length = glm::length(glm::dvec3(m[2]));
  if (!(z_length > 0.0)) return {};
  const glm::dvec3 z = glm::dvec3(m[2]) / z_length;
  const glm::dvec3 x = glm::cross(glm::dvec3(m[1]), z);
  const double x_length = glm::length(x);
  if (!(x_length > 1e-12 * glm::length(glm::dvec3(m[1])))) return {};
  return glm::dmat4(glm::dvec4(x / x_length, 0.0), glm::dvec4(glm::cross(z, x / x_length), 0.0), glm::dvec4(z, 0.0),
                    m[3]);
}

Poser::Poser(Scene& scene) : scene_(scene), bounds_(scene.meshes.size()) {
  for (size_t m = 0; m < bounds_.size(); ++m)
    for (const glm::vec3& p : scene.meshes[m].positions) bounds_[m].add(glm::dvec3(p));
}

void Poser::at_rest() {
  pose(scene_.nodes);
}

void Poser::at(const AnimationMoment& moment) {
  std::vector<Node> nodes = scene_.nodes;
  for (const Animation* const animation : find_animations(scene_, moment.animation)) {
    const bool loops = moment.loop && animation->length_s > 0.0;
    const double time_s = loops ? std::fmod(moment.time_s, animation->length_s) : moment.time_s;
    for (const Track& track : animation->tracks) apply(track, time_s, nodes[track.node]);
  }
  pose(nodes);
}

void Poser::pose(const std::vector<Node>& nodes) {
  world_from_node_ = world_from_nodes(nodes);
  for (Skin& skin : scene_.skins) {
    skin.world_from_bind.resize(skin.joints.size());
    for (size_t j = 0; j < skin.joints.size(); ++j)
      skin.world_from_bind[j] = world_from_node_[skin.joints[j]] * skin.joint_from_bind[j];
  }
  for (Instance& instance : scene_.instances) place(instance, nodes);
  for (Camera& camera : scene_.cameras) place(camera);
  for (Light& light : scene_.lights) place(light);
}

void Poser::place(Camera& camera) const {
  if (camera.node < 0) return;
  if (const auto placed = rigid(world_from_node_[static_cast<size_t>(camera.node)])) camera.world_from_view = *placed;
}

void Poser::place(Light& light) const {
  if (light.node < 0) return;
  const glm::dmat4& world = world_from_node_[static_cast<size_t>(light.node)];
  light.position_ws = glm::dvec3(world[3]);
  const double z_length = glm::length(glm::dvec3(world[2]));
  if (z_length > 0.0) light.direction_ws = -glm::dvec3(world[2]) / z_length;
}

void Poser::place(Instance& instance, const std::vector<Node>& nodes) const {
  if (instance.node < 0) return;
  const auto node = static_cast<size_t>(instance.node);
  std::fill(instance.morph_weights.begin(), instance.morph_weights.end(), 0.0f);
  for (size_t t = 0; t < std::min(instance.morph_weights.size(), nodes[node].morph_weights.size()); ++t)
    instance.morph_weights[t] = static_cast<float>(nodes[node].morph_weights[t]);
  if (instance.skin < 0) {
    instance.world_from_object = world_from_node_[node];
    check(instance.world_from_object, instance);
    return;
  }
  // The joints place the mesh; seen from one of them the numbers stay small, wherever the body stands.
  const Skin& skin = scene_.skins[static_cast<size_t>(instance.skin)];
  instance.world_from_object = glm::dmat4(1.0);
  instance.world_from_object[3] = world_from_node_[skin.joints.front()][3];
  for (const glm::dmat4& joint : skin.world_from_bind) check(joint, instance);
}

void Poser::check(const glm::dmat4& world_from_mesh, const Instance& instance) const {
  const Bounds& bounds = bounds_[instance.mesh];
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 p((corner & 1) ? bounds.max.x : bounds.min.x, (corner & 2) ? bounds.max.y : bounds.min.y,
                       (corner & 4) ? bounds.max.z : bounds.min.z);
    const glm::dvec3 world(world_from_mesh * glm::dvec4(p, 1.0));
    const std::string& name = scene_.nodes[static_cast<size_t>(instance.node)].name;
    double size = 0.0;
    for (int axis = 0; axis < 3; ++axis)
      size = std::isfinite(world[axis]) ? std::max(size, std::abs(world[axis])) : HUGE_VAL;
    if (size > double(std::numeric_limits<float>::max()))
      fail("the node '{}' moves its mesh out of the range of floating-point numbers", name);
    if (size > largest_coordinate)
      fail("the node '{}' has coordinates of {:.3g} units, and single precision copes with at most {:.0e}", name, size,
           largest_coordinate);
  }
}

std::vector<glm::dvec3> posed_positions(const Scene& scene, const Instance& instance) {
  const Mesh& mesh = scene.meshes[instance.mesh];
  std::vector<glm::dmat4> object_from_bind;
  if (instance.skin >= 0)
    for (const glm::dmat4& world_from_bind : scene.skins[static_cast<size_t>(instance.skin)].world_from_bind)
      object_from_bind.push_back(glm::inverse(instance.world_from_object) * world_from_bind);
  std::vector<glm::dvec3> out(mesh.positions.size());
  for (size_t i = 0; i < out.size(); ++i) {
    glm::dvec3 p(mesh.positions[i]);
    for (size_t t = 0; t < instance.morph_weights.size(); ++t)
      if (!mesh.targets[t].positions.empty())
        p += double(instance.morph_weights[t]) * glm::dvec3(mesh.targets[t].positions[i]);
    if (instance.skin < 0) {
      out[i] = p;
      continue;
    }
    for (size_t k = i * mesh.influences; k < (i + 1) * mesh.influences; ++k)
      out[i] += double(mesh.weights[k]) * glm::dvec3(object_from_bind[mesh.joints[k]] * glm::dvec4(p, 1.0));
  }
  return out;
}

std::vector<glm::dvec3> posed_positions_ws(const Scene& scene, const Instance& instance) {
  std::vector<glm::dvec3> positions = posed_positions(scene, instance);
  for (glm::dvec3& p : positions) p = glm::dvec3(instance.world_from_object * glm::dvec4(p, 1.0));
  return positions;
}

}  // namespace izb
