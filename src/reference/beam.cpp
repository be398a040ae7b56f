// SPDX-License-Identifier: MIT
#include "reference/beam.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <limits>

#include "reference/exact.h"
#include "reference/parallel.h"

namespace izb::reference {
namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();
constexpr size_t beams_per_chunk = 256;
constexpr int most_samples = 32;

double largest_of(const glm::dvec3& v) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

// Relative to a beam's centre.
struct Interval {
  double low = unbounded, high = -unbounded;
  void add(double value) { low = std::min(low, value), high = std::max(high, value); }
};

// Axes along which a box may lie apart from a beam, an array a component, for SIMD: four through an edge of the quad
// and the light, the quad's normal, three across the beam and along an edge of the box. An axis 0 parts nothing.
struct Axes {
  static constexpr int count = 8;
  double x[count] = {}, y[count] = {}, z[count] = {}, low[count] = {}, high[count] = {};
  int used = 0;

  void add(const glm::dvec3& n, double from, double to) {
    x[used] = n.x, y[used] = n.y, z[used] = n.z, low[used] = from, high[used] = to;
    ++used;
  }
  bool part(const glm::dvec3& center, const glm::dvec3& half) const {
    int apart = 0;
    for (int k = 0; k < count; ++k) {
      const double at = x[k] * center.x + y[k] * center.y + z[k] * center.z;
      const double reach = std::abs(x[k]) * half.x + std::abs(y[k]) * half.y + std::abs(z[k]) * half.z;
      apart |= static_cast<int>(at - reach > high[k]) | static_cast<int>(at + reach < low[k]);
    }
    return apart != 0;
  }
};

// A plane's height over the samples; relative to the beam's centre.
struct Plane {
  glm::dvec3 normal;
  double offset;
  double at(const glm::dvec3& p) const { return offset - glm::dot(normal, p); }
};

class ShadowBeam {
 public:
  ShadowBeam(const LightPoint& light, const Receivers& receivers, size_t receiver, double scene_largest)
      : positional_(light.positional), samples_(receivers.sample_count()) {
    const MicroQuad quad = receivers.quad(receiver);
    glm::dvec2 low(unbounded), high(-unbounded);
    for (int s = 0; s < samples_; ++s) {
      const glm::dvec2& o = receivers.offsets_px[static_cast<size_t>(s)];
      low = glm::min(low, o), high = glm::max(high, o);
    }
    center_ = quad.at((low + high) * 0.5);
    for (int s = 0; s < samples_; ++s) {
      const glm::dvec3 p = quad.at(receivers.offsets_px[static_cast<size_t>(s)]) - center_;
      x_[s] = p.x, y_[s] = p.y, z_[s] = p.z;
    }
    corners_[0] = quad.at(low) - center_;
    corners_[1] = quad.at({high.x, low.y}) - center_;
    corners_[2] = quad.at(high) - center_;
    corners_[3] = quad.at({low.x, high.y}) - center_;
    to_light_ = positional_ ? glm::dvec3(light.xyz_vs) - center_ : glm::dvec3(light.xyz_vs);
    // As the rays' start: what is nearer is met by rounding alone.
    start_ = 8.0 * largest_of(center_) * 0x1p-23 / largest_of(to_light_);
    open_ = all_ = 0xFFFFFFFFu >> (most_samples - samples_);
    const double scale = scene_largest + largest_of(center_);
    end_ = positional_ ? to_light_ : to_light_ * (4.0 * scale / largest_of(to_light_));
    rounding_ = 1e-14 * (scale + largest_of(end_));
    bound();
  }

  uint32_t shadowed() const { return all_ & ~open_; }
  bool ended() const { return open_ == 0; }

  struct Met {
    bool meets;
    double distance;  ///< of the box's nearest point along the way to the light
  };
  Met meets(const Box& box) const {
    const glm::dvec3 lower = glm::dvec3(box.lower) - center_, upper = glm::dvec3(box.upper) - center_;
    for (int k = 0; k < 3; ++k)
      if (lower[k] > upper_[k] || upper[k] < lower_[k]) return {false, 0.0};
    const glm::dvec3 middle = (lower + upper) * 0.5, half = (upper - lower) * 0.5;
    if (axes_.part(middle, half)) return {false, 0.0};
    return {true, glm::dot(to_light_, middle) - glm::dot(glm::abs(to_light_), half)};
  }

  /// Takes the samples that the triangle shadows out of those that are lit.
  void test(const Corners& t, uint32_t triangle, const Cutouts* cutouts) {
    const glm::dvec3 a = glm::dvec3(t.a) - center_, b = glm::dvec3(t.b) - center_, c = glm::dvec3(t.c) - center_;
    const glm::dvec3 n = glm::cross(b - a, c - a);
    const double side = glm::dot(n, positional_ ? to_light_ - a : to_light_);
    if (side == 0.0 || !std::isfinite(side)) return;  // edge-on, or no triangle
    const double sign = side > 0.0 ? 1.0 : -1.0;
    const Plane planes[4] = {edge(a, b, sign), edge(b, c, sign), edge(c, a, sign), {n * sign, glm::dot(n, a) * sign}};
    const double least[4] = {0.0, 0.0, 0.0, start_ * std::abs(side)};
    for (int k = 0; k < 4; ++k) {
      double highest = -unbounded;
      for (const glm::dvec3& corner : corners_) highest = std::max(highest, planes[k].at(corner));
      if (highest < least[k] - slack(planes[k])) return;
    }
    uint32_t bits = bits_of(planes, least[3]) & open_;
    if (bits != 0 && cutouts && cutouts->masked(triangle)) bits = uncut(t, triangle, *cutouts, bits);
    open_ &= ~bits;
  }

 private:
  double slack(const Plane& plane) const {
    const glm::dvec3 size = glm::abs(plane.normal);
    return rounding_ * (size.x + size.y + size.z) + 1e-12 * std::abs(plane.offset);
  }

  // Of the samples within all edges and higher than that below the triangle. Plain loops over arrays, for SIMD.
  uint32_t bits_of(const Plane (&planes)[4], double least_height) const {
    double inside[most_samples], height[most_samples];
    for (int s = 0; s < samples_; ++s) {
      double at[4];
      for (int k = 0; k < 4; ++k) {
        const Plane& p = planes[k];
        at[k] = p.offset - (p.normal.x * x_[s] + p.normal.y * y_[s] + p.normal.z * z_[s]);
      }
      inside[s] = std::min(at[0], std::min(at[1], at[2]));
      height[s] = at[3];
    }
    uint32_t bits = 0;
    for (int s = 0; s < samples_; ++s) bits |= uint32_t{inside[s] >= 0.0 && height[s] > least_height} << s;
    return bits;
  }

  // Through the edge and the light, positive inside for a triangle that faces the light by `sign`.
  Plane edge(const glm::dvec3& first, const glm::dvec3& second, double sign) const {
    const glm::dvec3 n = glm::cross(second - first, positional_ ? to_light_ - first : to_light_) * sign;
    return {n, glm::dot(n, first)};
  }

  uint32_t uncut(const Corners& t, uint32_t triangle, const Cutouts& cutouts, uint32_t bits) const {
    uint32_t kept = 0;
    for (int s = 0; s < samples_; ++s) {
      const glm::dvec3 p(x_[s], y_[s], z_[s]);
      if ((bits >> s & 1u) && cutouts.there(triangle, t, center_ + p, positional_ ? to_light_ - p : to_light_))
        kept |= 1u << s;
    }
    return kept;
  }

  void bound() {
    const glm::dvec3 way = to_light_ / glm::length(to_light_);
    const auto across = [&](const glm::dvec3& axis) {
      const double length = glm::length(axis);
      if (!(length > 0.0)) return axes_.add(glm::dvec3(0.0), -unbounded, unbounded);
      const glm::dvec3 n = axis / length;
      // Also where rounding has left the axis not quite across.
      const Interval its = along(n);
      axes_.add(n, its.low - rounding_, its.high + rounding_);
    };
    for (size_t i = 0; i < 4; ++i) {
      const glm::dvec3 from = corners_[i];
      across(glm::cross(corners_[(i + 1) % 4] - from, positional_ ? to_light_ - from : to_light_));
    }
    for (const glm::dvec3& edge : {glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1)})
      across(glm::cross(edge, way));
    // Above the quad; of a ray, or of a quad that points at the light: beyond its first corner.
    const glm::dvec3 up = glm::cross(corners_[2] - corners_[0], corners_[3] - corners_[1]);
    across(glm::length(up) > 1e-30 ? up : way);
    for (int k = 0; k < 3; ++k) {
      glm::dvec3 axis(0.0);
      axis[k] = 1.0;
      const Interval its = along(axis);
      lower_[k] = its.low - rounding_, upper_[k] = its.high + rounding_;
    }
  }

  // Where the beam begins, and where it ends.
  Interval along(const glm::dvec3& n) const {
    const double light = glm::dot(n, to_light_), end = glm::dot(n, end_);
    const double share =
        start_ / (1.0 + start_) * (1.0 - 1e-6);  // of the way: see test(), where height stands over side
    Interval its;
    for (const glm::dvec3& corner : corners_) {
      const double from = glm::dot(n, corner);
      its.add(from + share * (positional_ ? light - from : light));
      its.add(positional_ ? end : from + end);
    }
    return its;
  }

  bool positional_;
  int samples_;
  glm::dvec3 center_, to_light_, corners_[4];  // corners around the quad, relative to its centre
  glm::dvec3 end_;                             // the light; of a directional one a point beyond the scene
  double start_, rounding_;
  double x_[most_samples], y_[most_samples], z_[most_samples];
  uint32_t open_, all_;
  Axes axes_;
  glm::dvec3 lower_, upper_;
};

// One thread's way through the hierarchy.
class Walk {
 public:
  Walk(const Triangles& triangles, const Hierarchy& hierarchy, const std::vector<uint8_t>& holding)
      : triangles_(triangles), hierarchy_(hierarchy), holding_(holding) {
    stack_.reserve(static_cast<size_t>(hierarchy.depth) + 2);
  }

  uint64_t node_tests() const { return node_tests_; }

  /// Returns the triangles tested.
  uint32_t trace(ShadowBeam& beam, uint32_t spared) {
    uint32_t tests = 0;
    stack_.clear();
    ++node_tests_;
    if (beam.meets(hierarchy_.root.box).meets) stack_.push_back(hierarchy_.root);
    while (!stack_.empty() && !beam.ended()) {
      const Entry entry = stack_.back();
      stack_.pop_back();
      if (entry.count != 0) {
        for (uint32_t i = 0; i < entry.count && !beam.ended(); ++i, ++tests)
          test(beam, hierarchy_.references[entry.first + i], spared);
        continue;
      }
      const Hierarchy::Node& node = hierarchy_.nodes[entry.first];
      const ShadowBeam::Met met[2] = {beam.meets(node[0].box), beam.meets(node[1].box)};
      node_tests_ += 2;
      const size_t nearest = met[1].distance < met[0].distance ? 1 : 0;
      for (const size_t child : {1 - nearest, nearest})
        if (met[child].meets) stack_.push_back(node[child]);
    }
    return tests;
  }

 private:
  struct Entry {
    Entry(const Hierarchy::Child& child) : first(child.first), count(child.count) {}  // NOLINT
    uint32_t first, count;
  };

  void test(ShadowBeam& beam, uint32_t triangle, uint32_t spared) {
    if (triangle == spared || (!holding_.empty() && holding_[triangle])) return;
    beam.test(corners(triangles_, triangle), triangle, triangles_.cutouts.get());
  }

  const Triangles& triangles_;
  const Hierarchy& hierarchy_;
  const std::vector<uint8_t>& holding_;
  std::vector<Entry> stack_;
  uint64_t node_tests_ = 0;
};

}  // namespace

BeamTracer::BeamTracer(const Triangles& triangles, unsigned threads)
    : triangles_(triangles), threads_(threads), hierarchy_(build_hierarchy(triangles_, threads)) {
  const Box& box = hierarchy_.root.box;
  largest_ = std::max(largest_of(glm::dvec3(box.lower)), largest_of(glm::dvec3(box.upper)));
}

BeamCount BeamTracer::trace(const LightPoint& light, const Receivers& receivers) const {
  receivers.check("trace beams");
  BeamCount count;
  count.build_ms = hierarchy_.build_ms;
  count.mask.resize(receivers.count());
  count.tests_a_pixel.resize(receivers.count());
  const auto start = std::chrono::steady_clock::now();
  std::vector<uint8_t> holding;
  if (light.positional) {
    holding.resize(triangles_.count());
    parallel_for(holding.size(), beams_per_chunk, threads_, [&](size_t begin, size_t end, unsigned) {
      for (size_t t = begin; t < end; ++t) holding[t] = holds_light(corners(triangles_, t), light);
    });
  }
  std::atomic<uint64_t> pixels{0}, tests{0}, node_tests{0};
  parallel_for(receivers.count(), beams_per_chunk, threads_, [&](size_t begin, size_t end, unsigned) {
    Walk walk(triangles_, hierarchy_, holding);
    uint64_t its_pixels = 0, its_tests = 0;
    for (size_t i = begin; i < end; ++i) {
      if (receivers.classes[i] != PixelClass::receiver) continue;
      ShadowBeam beam(light, receivers, i, largest_);
      count.tests_a_pixel[i] = walk.trace(beam, receivers.spared(i));
      const uint32_t bits = beam.shadowed();
      count.mask[i] = receivers.sample_count() == 1 ? (bits ? 0xFFFFFFFFu : 0u) : bits;
      ++its_pixels, its_tests += count.tests_a_pixel[i];
    }
    pixels += its_pixels, tests += its_tests, node_tests += walk.node_tests();
  });
  count.trace_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  count.pixels = pixels, count.tests = tests, count.node_tests = node_tests;
  return count;
}

}  // namespace izb::reference
