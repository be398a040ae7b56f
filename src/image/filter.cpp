// SPDX-License-Identifier: MIT
#include "image/filter.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace izb {
namespace {

template <typename T>
std::vector<T> filter_along_x(const std::vector<T>& plane, int width_px, int height_px, const Kernel& kernel) {
  const auto width = size_t(width_px), radius = kernel.size() / 2;
  std::vector<T> out(plane.size());
  std::vector<double> row(width + 2 * radius);
  for (size_t y = 0; y < size_t(height_px); ++y) {
    const auto from = plane.begin() + ptrdiff_t(y * width);
    std::fill_n(row.begin(), radius, double(from[0]));
    std::copy_n(from, width, row.begin() + ptrdiff_t(radius));
    std::fill_n(row.begin() + ptrdiff_t(radius + width), radius, double(from[ptrdiff_t(width) - 1]));
    for (size_t x = 0; x < width; ++x)
      out[y * width + x] = T(std::inner_product(kernel.begin(), kernel.end(), row.begin() + ptrdiff_t(x), 0.0));
  }
  return out;
}

/// Row by row, so that memory is read in its own order.
template <typename T>
std::vector<T> filter_along_y(const std::vector<T>& plane, int width_px, int height_px, const Kernel& kernel) {
  const auto width = size_t(width_px);
  const int radius = int(kernel.size() / 2);
  std::vector<T> out(plane.size());
  std::vector<double> sums(width);
  for (int y = 0; y < height_px; ++y) {
    std::fill(sums.begin(), sums.end(), 0.0);
    for (int j = -radius; j <= radius; ++j) {
      const T* const from = plane.data() + size_t(std::clamp(y + j, 0, height_px - 1)) * width;
      const double weight = kernel[size_t(j + radius)];
      for (size_t x = 0; x < width; ++x) sums[x] += weight * double(from[x]);
    }
    std::transform(sums.begin(), sums.end(), out.begin() + ptrdiff_t(size_t(y) * width), [](double s) { return T(s); });
  }
  return out;
}

template <typename T>
std::vector<T> filter_both(const std::vector<T>& plane, int width_px, int height_px, const Kernel& along_x,
                           const Kernel& along_y) {
  if (width_px < 1 || height_px < 1 || plane.size() != size_t(width_px) * size_t(height_px))
    throw std::logic_error("a plane to filter has the wrong size");
  if (along_x.size() % 2 == 0 || along_y.size() % 2 == 0) throw std::logic_error("a kernel has no middle");
  return filter_along_y(filter_along_x(plane, width_px, height_px, along_x), width_px, height_px, along_y);
}

}  // namespace

Kernel gaussian_kernel(double sigma_px, int radius_px) {
  Kernel kernel;
  for (int x = -radius_px; x <= radius_px; ++x) kernel.push_back(std::exp(-0.5 * x * x / (sigma_px * sigma_px)));
  const double sum = std::accumulate(kernel.begin(), kernel.end(), 0.0);
  for (double& weight : kernel) weight /= sum;
  return kernel;
}

std::vector<float> filter(const std::vector<float>& plane, int width_px, int height_px, const Kernel& along_x,
                          const Kernel& along_y) {
  return filter_both(plane, width_px, height_px, along_x, along_y);
}

std::vector<double> filter(const std::vector<double>& plane, int width_px, int height_px, const Kernel& along_x,
                           const Kernel& along_y) {
  return filter_both(plane, width_px, height_px, along_x, along_y);
}

}  // namespace izb
