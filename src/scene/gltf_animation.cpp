// SPDX-License-Identifier: MIT
#include "scene/gltf_animation.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <glm/gtc/quaternion.hpp>

#include "base/error.h"
#include "scene/gltf_accessor.h"

namespace izb {
namespace {

/// One property's keys: `width` numbers each, of a spline three times as many (in-tangent, value, out-tangent).
struct KeyTrack {
  std::vector<float> times_s;
  std::vector<double> values;
  Interpolation interpolation = Interpolation::linear;
  bool rotation = false;

  size_t width() const {
    return values.size() / times_s.size() / (interpolation == Interpolation::cubic_spline ? 3 : 1);
  }

  /// Part 0 to 2 of a spline's key; others have part 1 alone.
  const double* key(size_t k, size_t part = 1) const {
    const bool spline = interpolation == Interpolation::cubic_spline;
    return &values[spline ? (3 * k + part) * width() : k * width()];
  }

  std::vector<double> at(double time_s) const {
    const std::vector<double> single(key(0), key(0) + width());
    if (times_s.size() == 1 || time_s <= double(times_s.front())) return single;
    const size_t last = times_s.size() - 1;
    if (time_s >= double(times_s[last])) return {key(last), key(last) + width()};
    const auto next = std::upper_bound(times_s.begin(), times_s.end(), time_s,
                                       [](double t, float key_time) { return t < double(key_time); });
    return between(static_cast<size_t>(next - times_s.begin()) - 1, time_s);
  }

 private:
  std::vector<double> between(size_t k, double time_s) const {
    const double length_s = double(times_s[k + 1]) - double(times_s[k]);
    const double u = (time_s - double(times_s[k])) / length_s;
    std::vector<double> out(key(k), key(k) + width());
    if (interpolation == Interpolation::step) return out;
    if (interpolation == Interpolation::linear && rotation) {
      const auto quaternion = [](const double* q) { return glm::normalize(glm::dquat(q[3], q[0], q[1], q[2])); };
      const glm::dquat q = glm::slerp(quaternion(key(k)), quaternion(key(k + 1)), u);
      return {q.x, q.y, q.z, q.w};
    }
    const double u2 = u * u, u3 = u2 * u;
    for (size_t i = 0; i < out.size(); ++i)
      out[i] = interpolation == Interpolation::linear
                   ? (1.0 - u) * key(k)[i] + u * key(k + 1)[i]
                   : (2.0 * u3 - 3.0 * u2 + 1.0) * key(k)[i] + length_s * (u3 - 2.0 * u2 + u) * key(k, 2)[i] +
                         (3.0 * u2 - 2.0 * u3) * key(k + 1)[i] + length_s * (u3 - u2) * key(k + 1, 0)[i];
    return out;
  }
};

Interpolation interpolation_of(const std::string& name) {
  if (name == "LINEAR") return Interpolation::linear;
  if (name == "STEP") return Interpolation::step;
  if (name == "CUBICSPLINE") return Interpolation::cubic_spline;
  fail("there is no interpolation '{}'", name);
}

template <typename Vector>
std::vector<double> flattened(const std::vector<Vector>& vectors) {
  std::vector<double> out;
  out.reserve(vectors.size() * static_cast<size_t>(Vector::length()));
  for (const Vector& v : vectors)
    for (int c = 0; c < Vector::length(); ++c) out.push_back(double(v[c]));
  return out;
}

std::vector<double> read_values(const tinygltf::Model& model, int accessor, const std::string& path) {
  if (path == "rotation") return flattened(read_vec4(model, accessor));
  if (path == "weights") {
    const std::vector<float> floats = read_floats(model, accessor);
    return {floats.begin(), floats.end()};
  }
  return flattened(read_vec3(model, accessor));
}

KeyTrack read_track(const tinygltf::Model& model, const tinygltf::AnimationSampler& sampler, const std::string& path) {
  KeyTrack track;
  track.interpolation = interpolation_of(sampler.interpolation);
  track.rotation = path == "rotation";
  track.times_s = read_floats(model, sampler.input);
  track.values = read_values(model, sampler.output, path);
  if (track.times_s.empty()) fail("it has no key");
  for (size_t k = 0; k < track.times_s.size(); ++k) {
    if (!std::isfinite(track.times_s[k])) fail("the time of key {} is not finite", k);
    if (k > 0 && !(track.times_s[k] > track.times_s[k - 1])) fail("the time of key {} is not after that before", k);
  }
  if (!std::all_of(track.values.begin(), track.values.end(), [](double v) { return std::isfinite(v); }))
    fail("a value is not finite");
  const size_t parts = track.times_s.size() * (track.interpolation == Interpolation::cubic_spline ? 3 : 1);
  const size_t width = path == "rotation" ? 4 : path == "weights" ? track.values.size() / parts : 3;
  if (width == 0 || track.values.size() != parts * width)
    fail("it has {} numbers for {} keys", track.values.size(), track.times_s.size());
  return track;
}

/// The node's property of that name; null where it is none of glTF's own.
std::vector<double>* property_of(tinygltf::Node& node, const std::string& path) {
  if (path == "translation") return &node.translation;
  if (path == "rotation") return &node.rotation;
  if (path == "scale") return &node.scale;
  return path == "weights" ? &node.weights : nullptr;
}

size_t find_animation(const tinygltf::Model& model, const std::string& name) {
  if (model.animations.empty()) fail("it has no animation");
  if (name.empty()) return 0;
  std::string names;
  for (size_t i = 0; i < model.animations.size(); ++i) {
    if (model.animations[i].name == name) return i;
    names += fmt::format("{}{} '{}'", i == 0 ? "" : ", ", i, model.animations[i].name);
  }
  size_t index = 0;
  const char* const end = name.data() + name.size();
  const auto [rest, error] = std::from_chars(name.data(), end, index);
  if (error == std::errc() && rest == end && index < model.animations.size()) return index;
  fail("it has no animation '{}'; there are {}", name, names);
}

const tinygltf::AnimationSampler& sampler_of(const tinygltf::Animation& animation, int sampler) {
  if (sampler < 0 || static_cast<size_t>(sampler) >= animation.samplers.size())
    fail("its sampler is {}, but the animation's number of samplers is {}", sampler, animation.samplers.size());
  return animation.samplers[static_cast<size_t>(sampler)];
}

}  // namespace

std::vector<Animation> describe_animations(const tinygltf::Model& model) {
  std::vector<Animation> all;
  for (const tinygltf::Animation& animation : model.animations) {
    Animation info;
    info.name = animation.name;
    for (const tinygltf::AnimationSampler& sampler : animation.samplers)
      if (const std::vector<float> times_s = read_floats(model, sampler.input); !times_s.empty())
        info.length_s = std::max(info.length_s, double(times_s.back()));
    all.push_back(std::move(info));
  }
  return all;
}

void pose_nodes(tinygltf::Model& model, const AnimationMoment& moment) {
  const size_t index = find_animation(model, moment.animation);
  const tinygltf::Animation& animation = model.animations[index];
  for (size_t c = 0; c < animation.channels.size(); ++c) {
    const tinygltf::AnimationChannel& channel = animation.channels[c];
    if (channel.target_node < 0) continue;  // an extension says what it moves
    const std::string& path = channel.target_path;
    tinygltf::Node& node = model.nodes[static_cast<size_t>(channel.target_node)];
    std::vector<double>* const property = property_of(node, path);
    if (!property) continue;
    try {
      if (!node.matrix.empty() && path != "weights") fail("nodes[{}] has a matrix", channel.target_node);
      *property = read_track(model, sampler_of(animation, channel.sampler), path).at(moment.time_s);
    } catch (const Error& e) {
      fail("animations[{}].channels[{}]: {}", index, c, e.what());
    }
  }
}

}  // namespace izb
