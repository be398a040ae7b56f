// SPDX-License-Identifier: MIT
// The error of the tangent-plane model itself: samples with camera rays of their own.
#pragma once
#include <cstdint>
#include <span>

#include "reference/points.h"

namespace izb::reference {

struct ModelError {
  uint64_t compared = 0;   ///< samples of receivers whose own camera ray hits something
  uint64_t differing = 0;  ///< of them, those whose bit is not the shadow at that hit
  double percent() const {
    return compared ? 100.0 * static_cast<double>(differing) / static_cast<double>(compared) : 0.0;
  }
};

/// Compares each sample's bit with a shadow ray from the nearest hit of the camera ray through the sample's place in
/// the pixel: what a picture without the model would hold. They differ at creases and silhouettes, and where a
/// footprint is shrunk. Float rays, nothing settled. Throws izb::Error where the receivers are not one a pixel.
ModelError compare_model(const RayTracer& tracer, const Triangles& triangles, const LightPoint& light,
                         const PixelRays& rays, const Receivers& receivers, std::span<const uint32_t> mask);

}  // namespace izb::reference
