// SPDX-License-Identifier: MIT
// The CPU peer: Embree on the same frame, on the same cores, in the same run.
#pragma once
#include <nlohmann/json.hpp>

#include "reference/embree.h"
#include "shadow/renderer.h"

namespace izb {

/// Rebuilds the hierarchy of all the frame's triangles at each build quality, or at the one that builds fastest, and
/// traces one ray a sample of each receiver, in packets of 16. Wall times in milliseconds.
class Peer {
 public:
  /// Takes the triangles and receivers of the renderer's last frame.
  explicit Peer(const Renderer& renderer, bool fastest_build_only = false);
  void run();
  /// Medians: per quality rebuild_ms and trace_ms, with their samples, and sum_ms; fastest_rebuild_plus_trace_ms, rays.
  nlohmann::json to_json() const;

 private:
  struct Samples {
    const char* name;
    reference::BuildQuality quality;
    std::vector<double> rebuild_ms, trace_ms;
  };
  std::vector<reference::Receivers> receivers_;  ///< one a light, as the rest
  std::vector<reference::LightPoint> lights_;
  reference::RayTracer tracer_;
  std::vector<Samples> samples_;
  uint64_t rays_ = 0;
};

}  // namespace izb
