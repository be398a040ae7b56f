// SPDX-License-Identifier: MIT
// Where in a pixel the shadow samples lie. A pattern is data, the same for every technique.
#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "base/options.h"

namespace izb {

/// Sample s of a pixel is bit s of its mask word, except that a pattern of one sample fills the whole word.
struct SamplePattern {
  std::string name;
  std::vector<glm::vec2> offsets_px;  ///< from the pixel's centre, x right, y up, each in [-1/2, 1/2]; 1 or 32 of them
  bool lifted = false;                ///< the micro-quads on which they lie are lifted out of concave surfaces
  int count() const { return static_cast<int>(offsets_px.size()); }
};

inline constexpr int samples_a_word = 32;

/// The pixel's centre alone.
SamplePattern center_sample();
/// 32 points of the Halton sequence in bases 2 and 3, what the paper's authors used.
SamplePattern halton_samples();
/// 32 Hammersley points: a (0, 5, 2)-net in base 2, so that edges near an axis get even steps.
SamplePattern hammersley_samples();
/// 32 lines "x y", each in [-1/2, 1/2]; empty lines and what follows a # are skipped. Throws izb::Error that names the
/// file and the line.
SamplePattern read_samples(const std::string& path);

/// Where in its pixel the ray of supersampled frame `frame` passes, as Camera::pixel_shift has it: in [-1/2, 1/2).
/// Frame 0 passes through the centre. Sobol's points in base 2 in their first two dimensions, a (0, 2)-sequence: each
/// run of 2^k from a multiple of 2^k on has one point in each box of area 2^-k that halving the pixel gives, so that
/// any number of frames covers it evenly (I. M. Sobol', 1967; as computed by T. Kollig and A. Keller, Efficient
/// Multidimensional Sampling, 2002, with one fixed digital shift).
glm::dvec2 pixel_shift(uint32_t frame);

/// The options that every technique with sub-pixel samples has.
struct SampleOptions {
  std::string spp = "32";
  std::string pattern = "hammersley";
  std::string micro_quad = "lifted";

  /// Declares `spp`, `samples` and `micro-quad`.
  void declare(OptionSet& set);
  /// Throws izb::Error as read_samples does.
  SamplePattern samples() const;
};

}  // namespace izb
