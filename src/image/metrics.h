// SPDX-License-Identifier: MIT
// How far one image is from another, in numbers whose definitions leave no choice open. FLIP has its own file.
// Wrong sizes are bugs and throw std::logic_error.
#pragma once
#include <optional>
#include <span>
#include <vector>

#include "image/display.h"

namespace izb {

/// Differences of two planes of any numbers, in the planes' unit.
struct ValueDifference {
  double rmse = 0.0;      ///< root of the mean square
  double mean_abs = 0.0;  ///< mean of the absolute differences
  double largest = 0.0;   ///< largest absolute difference
  size_t largest_at = 0;  ///< its pixel, the first of equals
};
ValueDifference compare_values(std::span<const float> reference, std::span<const float> test);

/// Root of the mean square difference of code values, over all pixels and the three components: in [0, 1].
double rmse(const DisplayImage& reference, const DisplayImage& test);

/// Peak signal to noise ratio for a peak of 1: -20 log10(rmse). Infinite for 0.
double psnr_db(double rmse);

/// 0.2126 R + 0.7152 G + 0.0722 B of the code values (Rec. 709 weights), in double.
std::vector<double> luma(const DisplayImage& image);

/// The mean structural similarity of the luma (Wang, Bovik, Sheikh and Simoncelli 2004): 11 x 11 windows with Gaussian
/// weights, sigma = 1.5 pixels, their sum 1; variances by those weights alone, without the sample correction;
/// K1 = 0.01, K2 = 0.03, L = 1; the mean over the pixels whose window lies within the image. In [-1, 1], 1 for equal
/// images. Nothing where no window fits: a side below 11 pixels.
std::optional<double> ssim(const DisplayImage& reference, const DisplayImage& test);

/// A map of errors in a few numbers.
struct Pooled {
  double mean = 0.0;
  double weighted_median = 0.0;  ///< half of the sum of all values lies in values up to this one (Andersson et al.
                                 ///< 2020, 5: the median of the histogram weighted by the error)
  double max = 0.0;
};
Pooled pool(std::span<const float> errors);

}  // namespace izb
