// SPDX-License-Identifier: MIT
#include "reference/model.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/error.h"
#include "reference/exact.h"

namespace izb::reference {
namespace {

constexpr size_t pixels_per_pass = 1 << 15;

// The hits as receivers of one sample each. Hits are moved onto their triangle's plane in double: Embree's t is
// rounded.
class Hits {
 public:
  Hits(const Triangles& triangles, const PixelRays& rays) : triangles_(triangles), rays_(rays) {}

  void clear() { origins_.clear(), directions_.clear(), receivers_ = {}; }

  void add_ray(const glm::dvec2& px) {
    origins_.emplace_back(rays_.origin_at(px.x, px.y));
    directions_.emplace_back(rays_.direction_at(px.x, px.y));
  }

  const Receivers& trace(const RayTracer& tracer) {
    const PrimaryHits hits =
        tracer.primary_hits(origins_, directions_, static_cast<float>(rays_.t_near), static_cast<float>(rays_.t_far));
    for (size_t k = 0; k < directions_.size(); ++k) {
      const bool hit = hits.triangle[k] != no_triangle;
      receivers_.points_vs.push_back(hit ? glm::vec3(on_plane(hits.triangle[k], k, hits.t[k])) : glm::vec3(0.0f));
      receivers_.own_triangle.push_back(hits.triangle[k]);
      receivers_.classes.push_back(hit ? PixelClass::receiver : PixelClass::sky);
      receivers_.band.push_back(0.0f);
    }
    return receivers_;
  }

 private:
  glm::dvec3 on_plane(uint32_t triangle, size_t k, float t) const {
    const Corners c = corners(triangles_, triangle);
    const glm::dvec3 n = normal(c), o(origins_[k]), d(directions_[k]);
    const double exact = glm::dot(n, glm::dvec3(c.a) - o) / glm::dot(n, d);
    // A triangle that is seen edge-on has no better t than the ray's.
    return o + d * (std::abs(exact - double{t}) < 1e-3 * double{t} ? exact : double{t});
  }

  const Triangles& triangles_;
  const PixelRays& rays_;
  std::vector<glm::vec3> origins_, directions_;
  Receivers receivers_;
};

}  // namespace

ModelError compare_model(const RayTracer& tracer, const Triangles& triangles, const LightPoint& light,
                         const PixelRays& rays, const Receivers& receivers, std::span<const uint32_t> mask) {
  receivers.check("compare with the model");
  const size_t width = static_cast<size_t>(std::max(rays.width_px, 0));
  const size_t count = width * static_cast<size_t>(std::max(rays.height_px, 0));
  if (receivers.count() != count || mask.size() != count)
    fail("cannot compare with the model: {} x {} pixels come with {} points and {} mask words", rays.width_px,
         rays.height_px, receivers.count(), mask.size());
  ModelError error;
  Hits hits(triangles, rays);
  std::vector<uint32_t> bits;
  for (size_t begin = 0; begin < count; begin += pixels_per_pass) {
    hits.clear();
    bits.clear();
    for (size_t i = begin; i < std::min(begin + pixels_per_pass, count); ++i) {
      if (receivers.classes[i] != PixelClass::receiver) continue;
      const glm::dvec2 center(i % width, i / width);
      for (int s = 0; s < receivers.sample_count(); ++s) {
        const glm::dvec2& offset = receivers.offsets_px[static_cast<size_t>(s)];
        hits.add_ray(center + glm::dvec2(offset.x, -offset.y));  // rows count downwards
        bits.push_back(receivers.bits_of(mask[i]) >> s & 1u);
      }
    }
    if (bits.empty()) continue;
    const Receivers& own = hits.trace(tracer);
    const std::vector<uint32_t> truth = tracer.trace_mask(light, own).mask;
    for (size_t k = 0; k < bits.size(); ++k) {
      if (own.classes[k] != PixelClass::receiver) continue;
      ++error.compared;
      error.differing += own.bits_of(truth[k]) != bits[k];
    }
  }
  return error;
}

}  // namespace izb::reference
