// SPDX-License-Identifier: MIT
#include "view/pixel_probe.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "shared/coverage.h"
#include "shared/insertion.h"
#include "view/light_space.h"

namespace izb {
namespace {

constexpr size_t unknown_triangle = std::numeric_limits<size_t>::max();

size_t own_triangle(const Snapshot& s, size_t i) {
  const glm::uvec2& id = s.gbuffer.id[i];
  return id.x == 0 || id.x > s.first_triangle.size() ? unknown_triangle : s.first_triangle[id.x - 1] + id.y;
}

/// Of a picture with one sample a pixel, as if it had more: from the pixel's triangle, or else facing the viewer.
glm::vec4 micro_quad_of(const Snapshot& s, std::span<const glm::vec3> triangles_vs, size_t i) {
  if (!s.gbuffer.micro_quad.empty()) return s.gbuffer.micro_quad[i];
  const float t = s.gbuffer.eye_distance[i];
  const size_t own = own_triangle(s, i);
  if (own >= triangles_vs.size() / 3) return {t, 0.0f, 0.0f, 1.0f};
  const glm::vec3* v = &triangles_vs[3 * own];
  return shared::micro_quad_data(s.camera, s.gbuffer.center_px(i), t, v[0], v[1], v[2]);
}

glm::dvec3 offset_point(const shared::MicroQuad& m, const glm::dvec2& o) {
  return glm::dvec3(m.center) + (glm::dvec3(m.along_x) * o.x + glm::dvec3(m.along_y) * o.y) /
                                    (1.0 + o.x * double(m.slope.x) + o.y * double(m.slope.y));
}

/// A plane through the receiver with the viewer in front of it.
class TangentPlane {
 public:
  TangentPlane(const Snapshot& s, size_t i, const shared::MicroQuad& m) : m_(m) {
    const glm::vec3 seen = shared::octahedral_direction(s.gbuffer.normal[i]);
    const glm::dvec3 n = seen == glm::vec3(0.0f) ? glm::dvec3(0, 0, 1) : glm::normalize(glm::dvec3(seen));
    const glm::dvec3 right(1, 0, 0), up(0, 1, 0);
    const glm::dvec3 x = right - n * n.x;
    x_ = glm::normalize(glm::dot(x, x) > 1e-6 ? x : glm::cross(up, n));
    y_ = glm::cross(n, x_);
    width_ = double(shared::pixel_width(s.camera, m.t));
  }
  glm::dvec2 operator()(const glm::dvec2& offset_px) const {
    const glm::dvec3 p = offset_point(m_, offset_px) - glm::dvec3(m_.center);
    return glm::dvec2(glm::dot(p, x_), glm::dot(p, y_)) / width_;
  }

 private:
  const shared::MicroQuad& m_;
  glm::dvec3 x_, y_;
  double width_;
};

/// Where light on its way to the micro-quad passes: a column, or to a positional light a pyramid with the light at its
/// tip. Only tells that a triangle is surely elsewhere.
class LightColumn {
 public:
  LightColumn(const shared::LightFrame& light, const shared::MicroQuad& m) {
    const bool positional = shared::is_positional(light);
    origin_ = positional ? glm::dvec3(light.origin) : glm::dvec3(m.center);
    z_ = glm::normalize(positional ? glm::dvec3(m.center) - origin_ : -glm::dvec3(light.to_light));
    const glm::dvec3 hint = std::abs(z_.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    x_ = glm::normalize(glm::cross(hint, z_));
    y_ = glm::cross(z_, x_);
    spread_ = positional ? 1.0 : 0.0;
    const glm::dvec3 center = position(glm::dvec3(m.center));
    for (int i = 0; i < 4; ++i) {
      const glm::dvec3 p = position(offset_point(m, glm::dvec2(shared::corner_offset(i))));
      if (positional && p.z < 0.01 * center.z) bounded_ = false;
      const glm::dvec2 across = glm::dvec2(p) / (positional ? p.z : 1.0);
      low_ = glm::min(low_, across);
      high_ = glm::max(high_, across);
      end_ = std::max(end_, p.z);
    }
    // Far above what double precision rounds.
    slack_ = 1e-8 * double(shared::norm1(m.center) + shared::norm1(glm::vec3(light.origin)) + m.extent);
  }

  bool surely_misses(const glm::vec3* v) const {
    const glm::dvec3 a = position(glm::dvec3(v[0])), b = position(glm::dvec3(v[1])), c = position(glm::dvec3(v[2]));
    const double slack = slack_ + 1e-12 * (std::abs(a.x) + std::abs(a.y) + std::abs(a.z));
    if (std::min({a.z, b.z, c.z}) > end_ + slack) return true;
    for (int k = 0; k < 2 && bounded_; ++k) {
      const double low = low_[k] * spread_, high = high_[k] * spread_;
      const double low_at_0 = low_[k] - low, high_at_0 = high_[k] - high;  // of a column
      if (std::min({a[k] - a.z * high, b[k] - b.z * high, c[k] - c.z * high}) > high_at_0 + slack) return true;
      if (std::max({a[k] - a.z * low, b[k] - b.z * low, c[k] - c.z * low}) < low_at_0 - slack) return true;
    }
    return false;
  }

 private:
  /// x and y across, z along the light's way.
  glm::dvec3 position(const glm::dvec3& p_vs) const {
    const glm::dvec3 p = p_vs - origin_;
    return {glm::dot(x_, p), glm::dot(y_, p), glm::dot(z_, p)};
  }

  glm::dvec3 origin_, x_, y_, z_;
  bool bounded_ = true;  // false: it reaches around the light
  double spread_;        // 1: across grows with z, as around a positional light
  glm::dvec2 low_{1e300}, high_{-1e300};
  double end_ = -1e300, slack_;
};

}  // namespace

ProbedPixel probe(const Snapshot& s, std::span<const glm::vec3> triangles_vs, const glm::ivec2& px) {
  const size_t i = s.index(px);
  const bool one_sample = s.samples.count() == 1;
  ProbedPixel probed{};
  probed.px = px;
  probed.mask = s.mask.empty() ? 0 : s.mask[i];
  probed.samples_px = s.samples.offsets_px;
  probed.receiver = class_of(s, i) == shared::class_receiver;
  if (s.built) probed.texels = texels_of_pixel(s, px);
  if (!probed.receiver) return probed;

  const glm::ivec2 at = shader_px(s, i);
  const glm::vec4 data = micro_quad_of(s, triangles_vs, i);
  const shared::MicroQuad quad = shared::make_micro_quad(s.camera, at, data);
  const TangentPlane tangent(s, i, quad);
  for (int k = 0; k < 4; ++k) probed.micro_quad_tangent[size_t(k)] = tangent(glm::dvec2(shared::corner_offset(k)));
  for (const glm::vec2& o : probed.samples_px) probed.samples_tangent.push_back(tangent(glm::dvec2(o)));

  const LightColumn column(s.light, quad);
  const size_t spared = data.x == s.gbuffer.eye_distance[i] ? own_triangle(s, i) : unknown_triangle;  // as Receivers
  uint32_t twice = 0;  // samples that more than one hides
  for (size_t k = 0; k < triangles_vs.size() / 3; ++k) {
    const glm::vec3* v = &triangles_vs[3 * k];
    if (k == spared || column.surely_misses(v)) continue;
    const shared::QuadPlanes planes = shared::quad_planes(s.camera, s.light, v[0], v[1], v[2], at, data);
    uint32_t bits = 0;
    if (one_sample) {
      if (shared::occludes(s.camera, s.light, v[0], v[1], v[2], quad.center, data.x)) bits = ~0u;
    } else {
      for (size_t n = 0; n < s.samples.offsets_px.size(); ++n)
        if (shared::occluded_sample(planes, s.samples.offsets_px[n])) bits |= 1u << n;
    }
    if (bits == 0) continue;
    const glm::dvec3 plane = planes.height - planes.bias * std::sqrt(planes.length2);
    probed.occluders.push_back({static_cast<uint32_t>(k), {planes.edge0, planes.edge1, planes.edge2, plane}, bits});
    twice |= probed.hidden & bits;
    probed.hidden |= bits;
  }
  for (const Occluder& o : probed.occluders) probed.counts[1] += (o.bits & ~twice) != 0;
  probed.counts[0] = static_cast<uint32_t>(probed.occluders.size());
  std::stable_sort(probed.occluders.begin(), probed.occluders.end(),
                   [](const Occluder& a, const Occluder& b) { return std::popcount(a.bits) > std::popcount(b.bits); });
  if (probed.occluders.size() > most_occluders) probed.occluders.resize(most_occluders);
  return probed;
}

}  // namespace izb
