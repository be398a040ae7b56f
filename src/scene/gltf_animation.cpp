// SPDX-License-Identifier: MIT
#include "scene/gltf_animation.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "scene/gltf_accessor.h"

namespace izb {
namespace {

Interpolation interpolation_of(const std::string& name) {
  if (name == "LINEAR") return Interpolation::linear;
  if (name == "STEP") return Interpolation::step;
  if (name == "CUBICSPLINE") return Interpolation::cubic_spline;
  fail("there is no interpolation '{}'", name);
}

/// Empty where it is none of glTF's own: an extension says what it is.
std::optional<AnimatedProperty> property_of(const std::string& path) {
  if (path == "translation") return AnimatedProperty::translation;
  if (path == "rotation") return AnimatedProperty::rotation;
  if (path == "scale") return AnimatedProperty::scale;
  if (path == "weights") return AnimatedProperty::morph_weights;
  return {};
}

template <typename Vector>
std::vector<float> flattened(const std::vector<Vector>& vectors) {
  std::vector<float> out;
  out.reserve(vectors.size() * static_cast<size_t>(Vector::length()));
  for (const Vector& v : vectors)
    for (int c = 0; c < Vector::length(); ++c) out.push_back(v[c]);
  return out;
}

std::vector<float> read_values(const tinygltf::Model& model, int accessor, AnimatedProperty property) {
  if (property == AnimatedProperty::rotation) return flattened(read_vec4(model, accessor));
  if (property == AnimatedProperty::morph_weights) return read_floats(model, accessor);
  return flattened(read_vec3(model, accessor));
}

/// Morph targets that the node's mesh has.
size_t target_count(const tinygltf::Model& model, int node) {
  size_t count = 0;
  const int mesh = model.nodes[static_cast<size_t>(node)].mesh;
  if (mesh >= 0)
    for (const tinygltf::Primitive& primitive : model.meshes[static_cast<size_t>(mesh)].primitives)
      count = std::max(count, primitive.targets.size());
  return count;
}

Track read_track(const tinygltf::Model& model, const tinygltf::AnimationSampler& sampler, AnimatedProperty property,
                 size_t targets) {
  Track track;
  track.property = property;
  track.interpolation = interpolation_of(sampler.interpolation);
  track.times_s = read_floats(model, sampler.input);
  if (track.times_s.empty()) fail("it has no key");
  for (size_t k = 0; k < track.times_s.size(); ++k) {
    if (!std::isfinite(track.times_s[k])) fail("the time of key {} is not finite", k);
    if (k > 0 && !(track.times_s[k] > track.times_s[k - 1])) fail("the time of key {} is not after that before", k);
  }
  const size_t parts = track.times_s.size() * (track.interpolation == Interpolation::cubic_spline ? 3 : 1);
  const size_t values = accessor_count(model, sampler.output), of_each = values / parts;
  const bool weights = property == AnimatedProperty::morph_weights;
  // Counted before they are read: an accessor may claim many numbers and hold none.
  if (values == 0 || values % parts != 0 || of_each > (weights ? targets : 1))
    fail("it has {} numbers for {} keys", values, track.times_s.size());
  track.values = read_values(model, sampler.output, property);
  if (!std::all_of(track.values.begin(), track.values.end(), [](float v) { return std::isfinite(v); }))
    fail("a value is not finite");
  return track;
}

const tinygltf::AnimationSampler& sampler_of(const tinygltf::Animation& animation, int sampler) {
  if (sampler < 0 || static_cast<size_t>(sampler) >= animation.samplers.size())
    fail("its sampler is {}, but the animation's number of samplers is {}", sampler, animation.samplers.size());
  return animation.samplers[static_cast<size_t>(sampler)];
}

std::vector<Track> read_tracks(const tinygltf::Model& model, const NodeHierarchy& nodes, size_t index) {
  std::vector<Track> tracks;
  const tinygltf::Animation& animation = model.animations[index];
  for (size_t c = 0; c < animation.channels.size(); ++c) {
    const tinygltf::AnimationChannel& channel = animation.channels[c];
    const std::optional<AnimatedProperty> property = property_of(channel.target_path);
    if (channel.target_node < 0 || !property) continue;
    const auto node = static_cast<size_t>(channel.target_node);
    const size_t targets = target_count(model, channel.target_node);
    if (property == AnimatedProperty::morph_weights && targets == 0) continue;
    try {
      if (!model.nodes[node].matrix.empty() && property != AnimatedProperty::morph_weights)
        fail("nodes[{}] has a matrix", node);
      tracks.push_back(read_track(model, sampler_of(animation, channel.sampler), *property, targets));
      tracks.back().node = static_cast<uint32_t>(nodes.scene_index[node]);
    } catch (const Error& e) {
      fail("animations[{}].channels[{}]: {}", index, c, e.what());
    }
  }
  return tracks;
}

}  // namespace

void load_animations(const tinygltf::Model& model, const NodeHierarchy& nodes, Scene& scene) {
  for (size_t i = 0; i < model.animations.size(); ++i) {
    Animation animation;
    animation.name = model.animations[i].name;
    try {
      animation.tracks = read_tracks(model, nodes, i);
    } catch (const Error& e) {
      animation.fault = e.what();
    }
    for (const Track& track : animation.tracks)
      animation.length_s = std::max(animation.length_s, double(track.times_s.back()));
    scene.animations.push_back(std::move(animation));
  }
}

}  // namespace izb
