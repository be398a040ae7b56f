// SPDX-License-Identifier: MIT
#include "scene/procedural/builder.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <utility>

#include "scene/portable_math.h"
#include "scene/procedural.h"

namespace izb::procedural {

using glm::dmat4;
using glm::dvec3;
using glm::dvec4;

Builder::Builder(const char* name, uint32_t seed, double detail, bool counting)
    : seed_(uint64_t{seed} * 0x9e3779b97f4a7c15ull), detail_(detail), counting_(counting) {
  scene_.name = name;
}

size_t Builder::triangle_count() const {
  size_t count = placed_ + added_;
  for (const Batch& batch : batches_)
    if (!batch.part) count += batch.triangles;
  return count;
}

double Builder::next_dither() {
  dither_ += 0.6180339887498949;  // the golden ratio: each draw falls into the widest gap
  dither_ -= std::floor(dither_);
  return dither_;
}

int Builder::rounded(double number, int least) {
  return std::max(least, int(std::floor(number + next_dither())));
}

int Builder::pieces(double at_default, int least) {
  return rounded(at_default * detail_, least);
}

int Builder::flat_pieces(double size_m) {
  return detail_ <= 1.0 ? 1 : rounded(size_m / flat_edge_m_ * (detail_ - 1.0), 1);
}

bool Builder::keeps(double from_detail) {
  return detail_ / from_detail - 0.5 > next_dither();
}

uint32_t Builder::material(const char* name, const glm::vec3& color, bool double_sided) {
  scene_.materials.push_back(matte(name, color, double_sided));
  batches_.push_back({name, uint32_t(scene_.materials.size() - 1)});
  return uint32_t(scene_.materials.size() - 1);
}

Pen Builder::pen(uint32_t material, const dmat4& world_from_pen) {
  const auto batch =
      std::find_if(batches_.begin(), batches_.end(), [&](const Batch& b) { return !b.part && b.material == material; });
  return {*this, *batch, world_from_pen};
}

Pen Builder::part(const char* name, uint32_t material) {
  batches_.push_back({name, material, true});
  return {*this, batches_.back(), dmat4{1.0}};
}

void Builder::place(const Pen& part, const dmat4& world_from_part) {
  placed_ += part.batch().triangles;
  if (!counting_ && part.batch().mesh >= 0) scene_.instances.push_back({uint32_t(part.batch().mesh), world_from_part});
}

void Builder::camera(const char* name, const View& view, double yfov_deg) {
  Camera c;
  c.name = name;
  c.world_from_view = looking(view);
  c.yfov_rad = yfov_deg * degree;
  c.near_plane = 0.05;
  scene_.cameras.push_back(c);
}

void Builder::path(const std::vector<View>& stops, double length_s, bool closed, double yfov_deg) {
  const int count = int(stops.size()), spans = closed ? count : count - 1;
  const auto stop = [&](int i) -> const View& {
    return stops[size_t(closed ? (i + count) % count : std::clamp(i, 0, count - 1))];
  };
  // Catmull and Rom's spline: through every stop, with a steady heading.
  const auto between = [](const dvec3& a, const dvec3& b, const dvec3& c, const dvec3& d, double t) {
    return 0.5 * (2.0 * b + t * (c - a) + t * t * (2.0 * a - 5.0 * b + 4.0 * c - d) +
                  t * t * t * (3.0 * b - a - 3.0 * c + d));
  };
  const auto view_at = [&](double x) {
    const int i = std::min(int(x), spans - 1);
    const double t = x - i;
    const View &a = stop(i - 1), &b = stop(i), &c = stop(i + 1), &d = stop(i + 2);
    return View{between(a.eye, b.eye, c.eye, d.eye, t), between(a.target, b.target, c.target, d.target, t)};
  };
  constexpr double keys_a_second = 8.0;
  const int keys = int(length_s * keys_a_second);
  Track move, turn;
  move.property = AnimatedProperty::translation;
  turn.property = AnimatedProperty::rotation;
  move.node = turn.node = uint32_t(scene_.nodes.size());
  glm::dquat last{1.0, 0.0, 0.0, 0.0};
  for (int k = 0; k <= keys; ++k) {
    const dmat4 pose = looking(view_at(double(spans) * k / keys));
    glm::dquat q = glm::normalize(glm::quat_cast(glm::dmat3{pose}));
    if (k > 0 && glm::dot(q, last) < 0.0) q = -q;  // the shorter way round
    last = q;
    move.times_s.push_back(float(length_s * k / keys));
    for (const double v : {pose[3].x, pose[3].y, pose[3].z}) move.values.push_back(float(v));
    for (const double v : {q.x, q.y, q.z, q.w}) turn.values.push_back(float(v));
  }
  turn.times_s = move.times_s;

  Node node;
  node.name = "path";
  node.translation = {double(move.values[0]), double(move.values[1]), double(move.values[2])};
  node.rotation = glm::normalize(
      glm::dquat{double(turn.values[3]), double(turn.values[0]), double(turn.values[1]), double(turn.values[2])});
  camera("path", stops[0], yfov_deg);
  scene_.cameras.back().node = int(scene_.nodes.size());
  scene_.cameras.back().world_from_view = translated(node.translation) * glm::mat4_cast(node.rotation);
  scene_.nodes.push_back(node);
  Animation animation;
  animation.name = "path";
  animation.length_s = length_s;
  animation.tracks = {std::move(move), std::move(turn)};
  scene_.animations.push_back(std::move(animation));
}

void Builder::sun(const char* name, double azimuth_deg, double elevation_deg, const glm::vec3& color, float intensity) {
  Light light;
  light.name = name;
  light.direction_ws = -towards(azimuth_deg, elevation_deg);
  light.color = color;
  light.intensity = intensity;
  scene_.lights.push_back(light);
}

Scene Builder::finish() {
  // As a file has them: what a node places comes last.
  std::stable_partition(scene_.cameras.begin(), scene_.cameras.end(), [](const Camera& c) { return c.node < 0; });
  return std::move(scene_);
}

dvec3 towards(double azimuth_deg, double elevation_deg) {
  const glm::dvec2 around = on_circle(azimuth_deg * degree), up = on_circle(elevation_deg * degree);
  return {around.y * up.x, up.y, -around.x * up.x};
}

dmat4 translated(const dvec3& by) {
  dmat4 m{1.0};
  m[3] = dvec4{by, 1.0};
  return m;
}

dmat4 turned(int axis, double angle_deg) {
  const glm::dvec2 on = on_circle(angle_deg * degree);
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  dmat4 m{1.0};
  m[u][u] = m[v][v] = on.x;
  m[u][v] = on.y;
  m[v][u] = -on.y;
  return m;
}

dmat4 at(const dvec3& position, double turn_deg) {
  return translated(position) * turned(1, turn_deg);
}

dvec3 across(const dvec3& direction) {
  const dvec3 d = glm::normalize(direction);
  return glm::normalize(glm::cross(d, std::abs(d.y) < 0.9 ? dvec3{0, 1, 0} : dvec3{1, 0, 0}));
}

dmat4 along(const dvec3& position, const dvec3& up) {
  const dvec3 y = glm::normalize(up), x = across(y);
  return {dvec4{x, 0}, dvec4{y, 0}, dvec4{glm::cross(x, y), 0}, dvec4{position, 1}};
}

dmat4 looking(const View& view) {
  const dvec3 z = glm::normalize(view.eye - view.target), x = glm::normalize(glm::cross(dvec3{0, 1, 0}, z));
  return {dvec4{x, 0}, dvec4{glm::cross(z, x), 0}, dvec4{z, 0}, dvec4{view.eye, 1}};
}

}  // namespace izb::procedural
