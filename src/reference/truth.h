// SPDX-License-Identifier: MIT
// Ground truth on the CPU. Shares no code with glsl/shared: a mistake there must show here.
//
// All positions are floats in view space (camera at the origin, looking along -z), exactly the floats that
// the GPU stages work on; the truth about them is computed without error (GMP rationals) wherever rays
// dispute a bit.
#pragma once
#include <bit>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <vector>

#include "reference/cutouts.h"
#include "reference/micro_quad.h"

namespace izb::reference {

/// All triangles of the frame, instances flattened: triangle i is vertices 3i, 3i+1, 3i+2.
struct Triangles {
  std::vector<glm::vec3> positions_vs;
  std::shared_ptr<const Cutouts> cutouts{};  ///< null: all are opaque
  size_t count() const { return positions_vs.size() / 3; }
};

inline constexpr uint32_t no_triangle = 0xFFFFFFFFu;

/// The light as the GPU has it. Directional: `xyz_vs` points from the scene TO the light (need not be unit
/// length). Positional (spot): `xyz_vs` is the light's position.
struct LightPoint {
  glm::vec3 xyz_vs{0.0f};
  bool positional = false;
  float band = 0.0f;  ///< of a positional light, in world units: see holds_light() in exact.h
};

/// What a pixel is to the comparison.
enum class PixelClass : uint8_t { receiver, sky, culled, outside_cone };

/// The receiver points, one a pixel, and where around each of them the shadow samples lie.
struct Receivers {
  std::vector<glm::vec3> points_vs;
  std::vector<uint32_t> own_triangle;  ///< index into Triangles of the triangle that the point lies on, or no_triangle
  std::vector<PixelClass> classes;
  std::vector<float> band;  ///< radius in world units within which a bit may be explained: 1/64 pixel
  int width_px = 0;         ///< pixels a row; 0: no image. Only the shape of ray packets depends on it

  std::vector<glm::dvec2> offsets_px{glm::dvec2(0.0)};  ///< samples, from the pixel's centre, y up; 1 or 32
  PixelSteps camera;
  std::vector<glm::vec3> centers_vs;  ///< of the micro-quads, lifted over their tangent planes; empty: the points
  std::vector<glm::dvec2> slopes;  ///< of the tangent planes, see micro_quad.h; empty: each sample is its pixel's point

  size_t count() const { return points_vs.size(); }
  int sample_count() const { return static_cast<int>(offsets_px.size()); }

  glm::vec3 center(size_t i) const { return centers_vs.empty() ? points_vs[i] : centers_vs[i]; }
  /// The triangle that casts nothing on receiver i: its own, on whose plane its samples lie. Lifted over it they are on
  /// one side of it, and with light from the other one it hides them as any other triangle.
  uint32_t spared(size_t i) const {
    return centers_vs.empty() || centers_vs[i] == points_vs[i] ? own_triangle[i] : no_triangle;
  }
  MicroQuad quad(size_t i) const {
    return slopes.empty() ? MicroQuad{points_vs[i]} : micro_quad(center(i), slopes[i], camera);
  }
  /// Sample s of receiver i in view space.
  glm::dvec3 point(size_t i, int s) const { return quad(i).at(offsets_px[static_cast<size_t>(s)]); }

  /// The bits of a mask word that sample s sets: one sample fills the word.
  uint32_t word_of(int s) const { return sample_count() == 1 ? 0xFFFFFFFFu : 1u << s; }
  /// A mask word with bit s for sample s and no other bit; of one sample, half the bits set or more are shadow.
  uint32_t bits_of(uint32_t word) const { return sample_count() == 1 ? std::popcount(word) >= 16 : word; }

  /// Throws izb::Error, "cannot {doing}: ...", where the arrays differ in length or the samples are not 1 or 32.
  void check(const char* doing) const;
};

}  // namespace izb::reference
