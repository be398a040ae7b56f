// SPDX-License-Identifier: MIT
#include "image/metrics.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "image/filter.h"

namespace izb {
namespace {

void need_equal_sizes(const DisplayImage& a, const DisplayImage& b) {
  if (a.width_px != b.width_px || a.height_px != b.height_px)
    throw std::logic_error("images to compare differ in size");
}

}  // namespace

ValueDifference compare_values(std::span<const float> reference, std::span<const float> test) {
  if (reference.size() != test.size()) throw std::logic_error("planes to compare differ in size");
  ValueDifference result;
  double squares = 0.0, sum = 0.0;
  for (size_t i = 0; i < reference.size(); ++i) {
    const double error = std::abs(double(test[i]) - double(reference[i]));
    squares += error * error;
    sum += error;
    if (error > result.largest) result.largest = error, result.largest_at = i;
  }
  const double count = std::max(double(reference.size()), 1.0);
  result.rmse = std::sqrt(squares / count);
  result.mean_abs = sum / count;
  return result;
}

double rmse(const DisplayImage& reference, const DisplayImage& test) {
  need_equal_sizes(reference, test);
  double squares = 0.0;
  for (size_t c = 0; c < 3; ++c) {
    const double of_component = compare_values(reference.rgb[c], test.rgb[c]).rmse;
    squares += of_component * of_component;
  }
  return std::sqrt(squares / 3.0);
}

double psnr_db(double rmse) {
  return 0.0 - 20.0 * std::log10(rmse);  // not -0 for 1
}

std::vector<double> luma(const DisplayImage& image) {
  std::vector<double> values(image.rgb[0].size());
  for (size_t i = 0; i < values.size(); ++i)
    values[i] = 0.2126 * double(image.rgb[0][i]) + 0.7152 * double(image.rgb[1][i]) + 0.0722 * double(image.rgb[2][i]);
  return values;
}

std::optional<double> ssim(const DisplayImage& reference, const DisplayImage& test) {
  need_equal_sizes(reference, test);
  constexpr int radius = 5;
  constexpr double c1 = 0.01 * 0.01, c2 = 0.03 * 0.03;
  const int width = reference.width_px, height = reference.height_px;
  if (width <= 2 * radius || height <= 2 * radius) return std::nullopt;

  const Kernel window = gaussian_kernel(1.5, radius);
  const std::vector<double> a = luma(reference), b = luma(test);
  const auto mean = [&](const std::vector<double>& plane) { return filter(plane, width, height, window, window); };
  const auto mean_product = [&](const std::vector<double>& p, const std::vector<double>& q) {
    std::vector<double> products(p.size());
    std::transform(p.begin(), p.end(), q.begin(), products.begin(), std::multiplies<>());
    return mean(products);
  };
  const std::vector<double> mean_a = mean(a), mean_b = mean(b);
  const std::vector<double> mean_aa = mean_product(a, a), mean_bb = mean_product(b, b), mean_ab = mean_product(a, b);

  double sum = 0.0;
  for (int y = radius; y < height - radius; ++y)
    for (int x = radius; x < width - radius; ++x) {
      const size_t i = size_t(y) * size_t(width) + size_t(x);
      const double aa = mean_a[i] * mean_a[i], bb = mean_b[i] * mean_b[i], ab = mean_a[i] * mean_b[i];
      sum += (2.0 * ab + c1) * (2.0 * (mean_ab[i] - ab) + c2) /
             ((aa + bb + c1) * (mean_aa[i] - aa + mean_bb[i] - bb + c2));
    }
  return sum / (double(width - 2 * radius) * (height - 2 * radius));
}

Pooled pool(std::span<const float> errors) {
  if (errors.empty()) throw std::logic_error("nothing to pool");
  std::vector<float> sorted(errors.begin(), errors.end());
  std::sort(sorted.begin(), sorted.end());
  const double sum = std::accumulate(sorted.begin(), sorted.end(), 0.0);
  double below = 0.0;
  const auto median = std::find_if(sorted.begin(), sorted.end(), [&](float value) {
    below += double(value);
    return below >= 0.5 * sum;
  });
  return {sum / double(sorted.size()), median == sorted.end() ? 0.0 : double(*median), double(sorted.back())};
}

}  // namespace izb
