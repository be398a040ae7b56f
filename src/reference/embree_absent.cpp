// SPDX-License-Identifier: MIT
// Stands in for embree.cpp where the system has no Embree: every use is a named refusal.
#include "base/error.h"
#include "reference/embree.h"
#include "reference/hierarchy.h"

namespace izb::reference {

struct RayTracer::State {};

namespace {
[[noreturn]] void refuse() {
  fail(
      "this build has no Embree: install Embree 3 or 4 (Debian: libembree-dev) and build again to trace "
      "rays");
}
}  // namespace

bool embree_available() {
  return false;
}

const char* embree_version() {
  return "none";
}

RayTracer::RayTracer(const Triangles&, BuildQuality, unsigned) {
  refuse();
}
RayTracer::~RayTracer() = default;
RayTracer::RayTracer(RayTracer&&) noexcept = default;
RayTracer& RayTracer::operator=(RayTracer&&) noexcept = default;
double RayTracer::build_ms() const {
  refuse();
}
double RayTracer::rebuild(BuildQuality) {
  refuse();
}
MaskTrace RayTracer::trace_mask(const LightPoint&, const Receivers&) const {
  refuse();
}
PrimaryHits RayTracer::primary_hits(std::span<const glm::vec3>, std::span<const glm::vec3>, float, float) const {
  refuse();
}
Hierarchy build_hierarchy(const Triangles&, unsigned) {
  refuse();
}
AllHits RayTracer::all_hits(std::span<const glm::vec3>, std::span<const glm::vec3>, float,
                            std::span<const float>) const {
  refuse();
}

}  // namespace izb::reference
