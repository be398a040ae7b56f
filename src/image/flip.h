// SPDX-License-Identifier: MIT
// FLIP, the difference that a person sees between two images shown in turn at one place.
//
//   P. Andersson, J. Nilsson, T. Akenine-Moeller, M. Oskarsson, K. Astrom and M. D. Fairchild: "FLIP: A Difference
//   Evaluator for Alternating Images", Proceedings of the ACM on Computer Graphics and Interactive Techniques 3(2),
//   2020. For images that a display can show (LDR), with the paper's constants.
#pragma once
#include <vector>

#include "image/display.h"

namespace izb {

/// A 0.7 m wide display of 3840 pixels seen from 0.7 m, the paper's default.
inline constexpr double default_pixels_per_degree = 67.0206;

/// The error of each pixel in [0, 1], top row first: 0 where no difference is seen. `pixels_per_degree` of the viewer's
/// field of view. Throws std::logic_error if the sizes differ or there is no pixel.
std::vector<float> flip(const DisplayImage& reference, const DisplayImage& test,
                        double pixels_per_degree = default_pixels_per_degree);

}  // namespace izb
