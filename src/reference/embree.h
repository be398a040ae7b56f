// SPDX-License-Identifier: MIT
// Rays by Embree (Wald et al. 2014), the fast half of the ground truth and the fair CPU peer of every
// technique here: robust mode, packets of 16, all cores. Float rays err near edges: settle.h decides the bits
// that they dispute.
#pragma once
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "reference/truth.h"

namespace izb::reference {

/// Whether this build has Embree. Where it is false, constructing a RayTracer throws izb::Error.
bool embree_available();

/// "Embree 3.13.5", or "none".
const char* embree_version();

/// Embree's hierarchy builders. `low` (Morton codes, for scenes that change every frame) builds fastest.
enum class BuildQuality { low, medium, high };

/// A shadow mask and the wall time of tracing it, without the build.
struct MaskTrace {
  std::vector<uint32_t> mask;  ///< one word a receiver, as exact_mask() has them
  double trace_ms = 0.0;
  uint64_t rays = 0;
};

/// The nearest hit of each ray.
struct PrimaryHits {
  std::vector<uint32_t> triangle;  ///< index into Triangles, no_triangle where nothing is hit
  std::vector<float> t;            ///< distance in units of the ray's direction, infinity where nothing is hit
};

/// Every triangle that each ray hits, ascending.
struct AllHits {
  std::vector<size_t> first;        ///< one entry a ray, and the end
  std::vector<uint32_t> triangles;  ///< all lists, one after another

  std::span<const uint32_t> of(size_t ray) const {
    return {triangles.data() + first[ray], first[ray + 1] - first[ray]};
  }
};

/// A hierarchy over one frame's triangles. Move-only; owns its device, so several may live at once.
class RayTracer {
 public:
  /// Copies the triangles and builds. `threads` 0 means all cores, for the build and for tracing.
  /// Throws izb::Error without Embree, without triangles, and for an error that Embree reports.
  explicit RayTracer(const Triangles& triangles, BuildQuality quality = BuildQuality::medium, unsigned threads = 0);
  ~RayTracer();
  RayTracer(RayTracer&&) noexcept;
  RayTracer& operator=(RayTracer&&) noexcept;

  /// Wall time in ms of the last build of the hierarchy (the copy of the vertices is not part of it).
  double build_ms() const;

  /// Builds the hierarchy over the same vertices again, as a dynamic scene would each frame. Returns
  /// build_ms().
  double rebuild(BuildQuality quality);

  /// One shadow ray for each sample of each receiver, from the sample's point rounded to floats, to the light. The
  /// receiver's own triangle never occludes it. Throws izb::Error where the receivers' arrays differ in length.
  MaskTrace trace_mask(const LightPoint& light, const Receivers& receivers) const;

  /// Nearest hits that are there with t in [t_near, t_far]. `origins` has one entry for all rays or one a ray.
  PrimaryHits primary_hits(std::span<const glm::vec3> origins, std::span<const glm::vec3> directions,
                           float t_near = 0.0f, float t_far = std::numeric_limits<float>::infinity()) const;

  /// Every triangle with t in [t_near, the ray's t_far], by float arithmetic, with holes or without. All spans have one
  /// entry a ray. Works on the calling thread alone.
  AllHits all_hits(std::span<const glm::vec3> origins, std::span<const glm::vec3> directions, float t_near,
                   std::span<const float> t_far) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace izb::reference
