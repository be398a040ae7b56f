// SPDX-License-Identifier: MIT
// Separable filters over one plane of an image.
#pragma once
#include <vector>

namespace izb {

/// Weights of an odd number of taps, the middle one at offset 0.
using Kernel = std::vector<double>;

/// exp(-x^2 / (2 sigma_px^2)) at the offsets -radius_px to radius_px, divided by their sum.
Kernel gaussian_kernel(double sigma_px, int radius_px);

/// out(x, y) = the sum over the taps of along_x[i] along_y[j] in(x + i, y + j), summed in double; beyond the border
/// the plane has the border's values. `plane` has width times height values, top row first. Throws std::logic_error
/// for another number of values or an even kernel.
std::vector<float> filter(const std::vector<float>& plane, int width_px, int height_px, const Kernel& along_x,
                          const Kernel& along_y);
std::vector<double> filter(const std::vector<double>& plane, int width_px, int height_px, const Kernel& along_x,
                           const Kernel& along_y);

}  // namespace izb
