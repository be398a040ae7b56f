// SPDX-License-Identifier: MIT
// Ground truth on the CPU. Shares no code with glsl/shared: a mistake there must show here.
//
// All positions are floats in view space (camera at the origin, looking along -z), exactly the floats that
// the GPU stages work on; the truth about them is computed without error (GMP rationals) wherever rays
// dispute a bit.
#pragma once
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace izb::reference {

/// All triangles of the frame, instances flattened: triangle i is vertices 3i, 3i+1, 3i+2.
struct Triangles {
  std::vector<glm::vec3> positions_vs;
  size_t count() const { return positions_vs.size() / 3; }
};

/// The light as the GPU has it. Directional: `xyz_vs` points from the scene TO the light (need not be unit
/// length). Positional (spot): `xyz_vs` is the light's position.
struct LightPoint {
  glm::vec3 xyz_vs{0.0f};
  bool positional = false;
};

/// What a pixel is to the comparison.
enum class PixelClass : uint8_t { receiver, sky, culled, outside_cone };

/// The receiver points, one a pixel (or sample).
struct Receivers {
  std::vector<glm::vec3> points_vs;
  std::vector<uint32_t> own_triangle;  ///< index into Triangles of the triangle that the point lies on
  std::vector<PixelClass> classes;
  std::vector<float> band;  ///< radius in world units within which a bit may be explained: 1/64 pixel
  int width_px = 0;         ///< pixels a row; 0: no image. Only the shape of ray packets depends on it
};

}  // namespace izb::reference
