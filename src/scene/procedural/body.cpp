// SPDX-License-Identifier: MIT
#include "scene/procedural/body.h"

#include <algorithm>
#include <cmath>

namespace izb::procedural {

using glm::dvec3;

namespace {

/// A cone with round ends, flattened along z; parts melt into what stands before them over `melt`.
struct Part {
  dvec3 from, to;
  double from_radius, to_radius, melt, flat = 1.0;
};

std::vector<Part> make_parts() {
  std::vector<Part> parts{
      {{-0.06, 0.95, -0.01}, {0.06, 0.95, -0.01}, 0.125, 0.125, 0.0, 0.86},  // pelvis
      {{0, 0.98, 0}, {0, 1.16, 0.005}, 0.135, 0.130, 0.05, 0.80},            // belly
      {{0, 1.18, 0}, {0, 1.36, -0.005}, 0.140, 0.158, 0.06, 0.74},           // chest
      {{-0.075, 1.30, 0.055}, {0.075, 1.30, 0.055}, 0.055, 0.055, 0.06},
      {{-0.155, 1.43, -0.01}, {0.155, 1.43, -0.01}, 0.062, 0.062, 0.05},  // shoulders
      {{0, 1.42, -0.015}, {0, 1.52, -0.005}, 0.080, 0.055, 0.05},
      {{0, 1.47, -0.01}, {0, 1.60, 0.01}, 0.056, 0.054, 0.02},               // neck
      {{0, 1.685, -0.012}, {0, 1.695, 0.018}, 0.093, 0.088, 0.03},           // skull
      {{0, 1.63, 0.045}, {0, 1.605, 0.062}, 0.058, 0.044, 0.03},             // jaw
      {{0, 1.676, 0.100}, {0, 1.646, 0.116}, 0.008, 0.014, 0.014},           // nose
      {{-0.05, 1.642, 0.062}, {0.05, 1.642, 0.062}, 0.030, 0.030, 0.02},     // cheeks
      {{-0.036, 1.688, 0.084}, {0.036, 1.688, 0.084}, 0.018, 0.018, 0.016},  // brow
      {{-0.016, 1.601, 0.096}, {0.016, 1.601, 0.096}, 0.011, 0.011, 0.010},  // lips
  };
  for (const double s : {1.0, -1.0}) {
    const auto side = [&](double x, double y, double z) { return dvec3{s * x, y, z}; };
    const Part limbs[]{
        {side(0.090, 1.652, -0.008), side(0.096, 1.676, -0.016), 0.013, 0.016, 0.010},  // ear
        {side(0.185, 1.430, -0.01), side(0.355, 1.190, -0.02), 0.054, 0.043, 0.04},     // upper arm
        {side(0.355, 1.190, -0.02), side(0.415, 1.112, -0.008), 0.044, 0.046, 0.02},    // forearm
        {side(0.415, 1.112, -0.008), side(0.505, 0.985, 0.015), 0.046, 0.028, 0.02},
        {side(0.505, 0.985, 0.015), side(0.548, 0.915, 0.025), 0.029, 0.036, 0.02, 0.9},  // palm
        {side(0.100, 0.905, 0.0), side(0.112, 0.50, 0.008), 0.108, 0.074, 0.04},          // trousers
        {side(0.112, 0.50, 0.008), side(0.120, 0.13, -0.018), 0.075, 0.062, 0.03},
        {side(0.112, 0.37, -0.02), side(0.116, 0.28, -0.022), 0.060, 0.055, 0.03},    // calf
        {side(0.120, 0.16, -0.022), side(0.121, 0.07, -0.022), 0.038, 0.038, 0.004},  // ankle
        {side(0.121, 0.050, -0.060), side(0.126, 0.046, 0.060), 0.046, 0.046, 0.02},  // shoe
        {side(0.126, 0.044, 0.060), side(0.130, 0.036, 0.150), 0.045, 0.035, 0.02},
        {side(0.175, 1.432, -0.01), side(0.290, 1.282, -0.015), 0.064, 0.065, 0.005},  // sleeve
    };
    parts.insert(parts.end(), std::begin(limbs), std::end(limbs));
    for (int finger = 0; finger < 4; ++finger) {
      const double z = 0.050 - 0.019 * finger, length = finger == 0 || finger == 2 ? 0.072
                                                        : finger == 1              ? 0.080
                                                                                   : 0.058;
      const dvec3 knuckle = side(0.556, 0.893, z), middle = knuckle + length * 0.5 * side(0.45, -0.89, 0.0);
      parts.push_back({knuckle, middle, 0.0105, 0.0095, 0.010});
      parts.push_back({middle, middle + length * 0.5 * side(0.25, -0.97, 0.0), 0.0095, 0.0080, 0.004});
    }
    parts.push_back({side(0.522, 0.950, 0.045), side(0.520, 0.905, 0.078), 0.0145, 0.0110, 0.015});
    parts.push_back({side(0.520, 0.905, 0.078), side(0.530, 0.870, 0.086), 0.0110, 0.0090, 0.004});
  }
  return parts;
}

const std::vector<Part>& parts() {
  static const std::vector<Part> all = make_parts();
  return all;
}

double distance(const Part& part, dvec3 p) {
  dvec3 a = part.from, c = part.to;
  p.z = a.z + (p.z - a.z) / part.flat;
  const dvec3 axis = c - a;
  const double t = std::clamp(glm::dot(p - a, axis) / glm::dot(axis, axis), 0.0, 1.0);
  return part.flat * (glm::length(p - a - t * axis) - glm::mix(part.from_radius, part.to_radius, t));
}

double smooth_min(double a, double b, double melt) {
  if (melt <= 0.0) return std::min(a, b);
  const double h = std::max(melt - std::abs(a - b), 0.0) / melt;
  return std::min(a, b) - 0.25 * h * h * melt;
}

double field(const dvec3& p) {
  double d = 1e3;
  for (const Part& part : parts()) d = smooth_min(d, distance(part, p), part.melt);
  return d;
}

dvec3 gradient(const dvec3& p) {
  constexpr double e = 1e-4;
  const auto along = [&](const dvec3& axis) { return field(p + e * axis) - field(p - e * axis); };
  return {along({1, 0, 0}), along({0, 1, 0}), along({0, 0, 1})};
}

double bone_distance(const BoneShape& bone, const dvec3& p) {
  const dvec3 axis = bone.to - bone.from;
  const double t = std::clamp(glm::dot(p - bone.from, axis) / glm::dot(axis, axis), 0.0, 1.0);
  return glm::length(p - bone.from - t * axis);
}

/// Weights fall off smoothly with the distance beyond the nearest bone's, so that no neighbours part.
Influence influence_of(const dvec3& p) {
  constexpr std::array radius{0.115, 0.125, 0.140, 0.050, 0.085, 0.055, 0.040, 0.030, 0.055,
                              0.040, 0.030, 0.090, 0.060, 0.040, 0.090, 0.060, 0.040};
  constexpr double reach = 0.085;
  std::array<double, bone_count> away;
  for (size_t i = 0; i < bone_count; ++i) away[i] = bone_distance(skeleton()[i], p) - radius[i];
  const double nearest = *std::min_element(away.begin(), away.end());
  std::array<std::pair<double, uint16_t>, bone_count> pulls;
  for (size_t i = 0; i < bone_count; ++i) {
    const double left = std::max(0.0, 1.0 - (away[i] - nearest) / reach);
    pulls[i] = {-left * left, uint16_t(i)};
  }
  std::sort(pulls.begin(), pulls.end());
  // A fifth one's pull is taken off the four, so that they change smoothly when it takes the fourth's place.
  Influence influence;
  double sum = 0.0;
  for (size_t k = 0; k < 4; ++k) sum += pulls[4].first - pulls[k].first;
  for (size_t k = 0; k < 4; ++k) {
    influence.weights[k] = float((pulls[4].first - pulls[k].first) / sum);
    influence.joints[k] = influence.weights[k] > 0.0f ? pulls[k].second : uint16_t{0};
  }
  return influence;
}

Cloth cloth_of(const dvec3& p) {
  const double x = std::abs(p.x);
  if (p.y > 1.56) {
    const bool ear = x > 0.078 && p.z > -0.034 && p.y < 1.694;
    const double hairline = p.z > 0.0 ? 1.718 - 0.10 * p.z : 1.718 + 2.4 * p.z;  // falls behind the temples
    return !ear && p.y > std::max(hairline, 1.585) ? hair : skin;
  }
  if (p.y < 0.088) return shoes;
  if (p.y < 0.985 && x < 0.24) return trousers;
  const double down_the_arm = glm::dot(dvec3{x - 0.175, p.y - 1.432, 0}, glm::normalize(dvec3{0.115, -0.150, 0}));
  const bool torso = x < 0.17 || (x < 0.25 && p.y < 1.2);
  return p.y <= 1.515 && (torso || down_the_arm < 0.255) ? shirt : skin;
}

constexpr dvec3 low{-0.66, -0.02, -0.22}, high{0.66, 1.82, 0.28};

/// Surface nets: a vertex in each cell that the surface crosses, a quad for each crossed edge of the grid.
class Nets {
 public:
  explicit Nets(double cell) : cell_(cell), n_(glm::ivec3{glm::ceil((high - low) / cell)} + 1) {
    values_.assign(size_t(n_.x) * size_t(n_.y) * size_t(n_.z), 1.0f);
    vertex_.assign(values_.size(), -1);
    fill();
    for (int z = 0; z + 1 < n_.z; ++z)
      for (int y = 0; y + 1 < n_.y; ++y)
        for (int x = 0; x + 1 < n_.x; ++x) add_vertex({x, y, z});
    for (int axis = 0; axis < 3; ++axis) add_quads(axis);
  }
  Body take() { return std::move(body_); }

 private:
  size_t at(const glm::ivec3& i) const {
    return (size_t(i.z) * size_t(n_.y) + size_t(i.y)) * size_t(n_.x) + size_t(i.x);
  }
  dvec3 point(const glm::ivec3& i) const { return low + cell_ * dvec3{i}; }

  /// Blocks far from the surface are outside or inside as a whole: the field grows no faster than distance does.
  void fill() {
    constexpr int side = 6;
    for (int z = 0; z < n_.z; z += side)
      for (int y = 0; y < n_.y; y += side)
        for (int x = 0; x < n_.x; x += side) {
          const double middle = field(low + cell_ * (dvec3(x, y, z) + 0.5 * (side - 1)));
          const bool near = std::abs(middle) < 0.9 * side * cell_ * 1.3;
          for (int k = z; k < std::min(z + side, n_.z); ++k)
            for (int j = y; j < std::min(y + side, n_.y); ++j)
              for (int i = x; i < std::min(x + side, n_.x); ++i)
                values_[at({i, j, k})] = near ? field(point({i, j, k})) : middle;
        }
  }

  void add_vertex(const glm::ivec3& cell) {
    dvec3 sum{0.0};
    int crossings = 0;
    for (int axis = 0; axis < 3; ++axis)
      for (int k = 0; k < 4; ++k) {
        glm::ivec3 a = cell;
        a[(axis + 1) % 3] += k & 1, a[(axis + 2) % 3] += k >> 1;
        glm::ivec3 c = a;
        c[axis] += 1;
        const double va = values_[at(a)], vc = values_[at(c)];
        if ((va < 0.0) == (vc < 0.0)) continue;
        sum += glm::mix(point(a), point(c), va / (va - vc)), ++crossings;
      }
    if (crossings == 0) return;
    dvec3 p = sum / double(crossings);
    const dvec3 slope = gradient(p), normal = glm::normalize(slope);
    const double shift = std::clamp(field(p), -0.3 * cell_, 0.3 * cell_);
    p -= shift * normal;
    vertex_[at(cell)] = int32_t(body_.positions.size());
    body_.positions.push_back(p);
    body_.normals.push_back(normal);
    body_.influences.push_back(influence_of(p));
  }

  void add_quads(int axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (int z = 0; z < n_.z; ++z)
      for (int y = 0; y < n_.y; ++y)
        for (int x = 0; x < n_.x; ++x) {
          const glm::ivec3 a{x, y, z};
          if (a[axis] + 1 >= n_[axis] || a[u] == 0 || a[v] == 0 || a[u] + 1 >= n_[u] || a[v] + 1 >= n_[v]) continue;
          glm::ivec3 c = a;
          c[axis] += 1;
          const bool inside = values_[at(a)] < 0.0;
          if (inside == (values_[at(c)] < 0.0)) continue;
          std::array<uint32_t, 4> corner{};
          for (int k = 0; k < 4; ++k) {
            glm::ivec3 cell = a;
            cell[u] -= k == 0 || k == 3 ? 1 : 0, cell[v] -= k < 2 ? 1 : 0;
            corner[size_t(k)] = uint32_t(vertex_[at(cell)]);
          }
          if (!inside) std::swap(corner[1], corner[3]);
          add_quad(corner);
        }
  }

  void add_quad(const std::array<uint32_t, 4>& q) {
    const auto& p = body_.positions;
    const dvec3 middle = 0.25 * (p[q[0]] + p[q[1]] + p[q[2]] + p[q[3]]);
    std::vector<uint32_t>& out = body_.triangles[cloth_of(middle)];
    if (glm::length(p[q[0]] - p[q[2]]) < glm::length(p[q[1]] - p[q[3]]))
      out.insert(out.end(), {q[0], q[1], q[2], q[0], q[2], q[3]});
    else
      out.insert(out.end(), {q[0], q[1], q[3], q[1], q[2], q[3]});
  }

  double cell_;
  glm::ivec3 n_;
  std::vector<double> values_;
  std::vector<int32_t> vertex_;
  Body body_;
};

}  // namespace

const std::array<BoneShape, bone_count>& skeleton() {
  static const std::array<BoneShape, bone_count> bones{{
      {"hips", -1, {0, 0.95, 0}, {0, 1.06, 0}},
      {"spine", hips, {0, 1.06, 0}, {0, 1.22, 0}},
      {"chest", spine, {0, 1.22, 0}, {0, 1.46, -0.01}},
      {"neck", chest, {0, 1.46, -0.01}, {0, 1.575, 0.005}},
      {"head", neck, {0, 1.575, 0.005}, {0, 1.75, 0.02}},
      {"left arm", chest, {0.175, 1.432, -0.01}, {0.355, 1.190, -0.02}},
      {"left forearm", left_arm, {0.355, 1.190, -0.02}, {0.505, 0.985, 0.015}},
      {"left hand", left_forearm, {0.505, 0.985, 0.015}, {0.58, 0.83, 0.03}},
      {"right arm", chest, {-0.175, 1.432, -0.01}, {-0.355, 1.190, -0.02}},
      {"right forearm", right_arm, {-0.355, 1.190, -0.02}, {-0.505, 0.985, 0.015}},
      {"right hand", right_forearm, {-0.505, 0.985, 0.015}, {-0.58, 0.83, 0.03}},
      {"left thigh", hips, {0.100, 0.905, 0}, {0.112, 0.50, 0.008}},
      {"left shin", left_thigh, {0.112, 0.50, 0.008}, {0.121, 0.085, -0.022}},
      {"left foot", left_shin, {0.121, 0.085, -0.022}, {0.13, 0.04, 0.15}},
      {"right thigh", hips, {-0.100, 0.905, 0}, {-0.112, 0.50, 0.008}},
      {"right shin", right_thigh, {-0.112, 0.50, 0.008}, {-0.121, 0.085, -0.022}},
      {"right foot", right_shin, {-0.121, 0.085, -0.022}, {-0.13, 0.04, 0.15}},
  }};
  return bones;
}

Body make_body(double cell_m) {
  return Nets{cell_m}.take();
}

size_t body_triangles(double cell_m) {
  // Twice the body's projections along the three axes, over a cell's face: each edge that crosses makes a quad.
  constexpr double projections_m2 = 5.98;
  return size_t(projections_m2 / (cell_m * cell_m));
}

}  // namespace izb::procedural
