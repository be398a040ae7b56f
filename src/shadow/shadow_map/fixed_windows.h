// SPDX-License-Identifier: MIT
// Windows of the light that follow from the camera alone, whatever it sees. No GL.
#pragma once
#include <array>
#include <vector>

#include "scene/scene.h"
#include "shared/bounds.h"

namespace izb {

struct FixedWindows {
  std::array<shared::LightWindow, shared::max_layers> windows{};  ///< of layers that need none: guard.y is 0
  shared::CascadeRange range{};
};

/// What they are asked for.
struct FixedFit {
  double distance = 0.0;  ///< eye distance at which the last cascade ends, world units
  double lambda = 0.5;    ///< 0: uniform, 1: logarithmic splits
  bool stable = false;
  int margin_texels = 0;
};

/// Eye distances at which each cascade ends, by the practical split scheme (Zhang et al. 2006).
std::vector<double> split_frustum(double near, double distance, double lambda, int cascades);

/// Under a directional light each cascade's window is the box around its slice of the frustum as the light sees it, or
/// if it is to be stable a square around the slice's bounding sphere, moved by whole texels of the world (Valient
/// 2008); `light` has then world axes. Under any other light there is one window for each face: all that it lights.
FixedWindows make_fixed_windows(const Camera& camera, const shared::CameraFrame& frame, const shared::LightFrame& light,
                                const FixedFit& fit);

/// Eye distance of the furthest corner of such bounds, rounded up to a quarter of an octave, so that it seldom changes
/// while the camera moves.
double distance_of_end(const Camera& camera, const Bounds& world);

}  // namespace izb
