// SPDX-License-Identifier: MIT
#include "image/flip.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <span>
#include <stdexcept>

#include "image/cie.h"
#include "image/filter.h"
#include "image/srgb.h"

namespace izb {
namespace {

using cie::Triple;
using Plane = std::vector<float>;

constexpr double pi = std::numbers::pi;

// 4.3 and 4.4, as the paper names them.
constexpr double color_exponent = 0.7;       // q_c
constexpr double knee_of_range = 0.4;        // p_c: this share of the largest difference ...
constexpr double knee_of_result = 0.95;      // p_t: ... becomes this error
constexpr double feature_exponent = 0.5;     // q_f
constexpr double feature_width_deg = 0.082;  // w: of the detectors

/// Three planes of the opponent space.
struct Opponent {
  int width_px, height_px;
  std::array<Plane, 3> planes;

  size_t size() const { return planes[0].size(); }
  Triple at(size_t i) const { return {double(planes[0][i]), double(planes[1][i]), double(planes[2][i])}; }
};

Opponent to_opponent(const DisplayImage& image) {
  Opponent out{image.width_px, image.height_px, {}};
  const size_t count = image.rgb[0].size();
  for (Plane& plane : out.planes) plane.resize(count);
  for (size_t i = 0; i < count; ++i) {
    Triple linear{};
    for (size_t c = 0; c < 3; ++c) linear[c] = srgb_to_linear(double(image.rgb[c][i]));
    const Triple opponent = cie::xyz_to_opponent(cie::rgb_to_xyz(linear));
    for (size_t c = 0; c < 3; ++c) out.planes[c][i] = float(opponent[c]);
  }
  return out;
}

// ---- colour: what is too fine to be seen is filtered away (4.1)

/// One Gaussian of a contrast sensitivity function: a exp(-b f^2) of f cycles a degree.
struct Sensitivity {
  double a, b;
};
/// Table 1: the luminance and red-green channels have one, blue-yellow has two.
constexpr Sensitivity luminance{1.0, 0.0047}, red_green{1.0, 0.0053}, blue_yellow[] = {{34.1, 0.04}, {13.5, 0.025}};

/// Three standard deviations of the widest of them.
int sensitivity_radius_px(double pixels_per_degree) {
  return int(std::ceil(3.0 * std::sqrt(blue_yellow[0].b / (2.0 * pi * pi)) * pixels_per_degree));
}

/// In space it is a Gaussian again: exp(-pi^2 x^2 / b), x in degrees, at each pixel of the radius; not normalised.
Kernel sensitivity_kernel(const Sensitivity& s, double pixels_per_degree) {
  const int radius = sensitivity_radius_px(pixels_per_degree);
  Kernel kernel;
  for (int x = -radius; x <= radius; ++x) {
    const double degrees = x / pixels_per_degree;
    kernel.push_back(std::exp(-pi * pi * degrees * degrees / s.b));
  }
  return kernel;
}

/// Filters by the sum of the Gaussians, each with the weight a sqrt(pi / b), which is normalised as a whole.
Plane see(const Plane& plane, int width_px, int height_px, std::span<const Sensitivity> sensitivities,
          double pixels_per_degree) {
  std::vector<double> sums(plane.size());
  double weights = 0.0;
  for (const Sensitivity& s : sensitivities) {
    Kernel kernel = sensitivity_kernel(s, pixels_per_degree);
    const double area = std::accumulate(kernel.begin(), kernel.end(), 0.0);
    for (double& weight : kernel) weight /= area;
    const double weight = s.a * std::sqrt(pi / s.b) * area * area;
    const Plane filtered = filter(plane, width_px, height_px, kernel, kernel);
    for (size_t i = 0; i < sums.size(); ++i) sums[i] += weight * double(filtered[i]);
    weights += weight;
  }
  Plane seen(plane.size());
  std::transform(sums.begin(), sums.end(), seen.begin(), [&](double sum) { return float(sum / weights); });
  return seen;
}

Opponent see(const Opponent& image, double pixels_per_degree) {
  const int width = image.width_px, height = image.height_px;
  return {width,
          height,
          {see(image.planes[0], width, height, {&luminance, 1}, pixels_per_degree),
           see(image.planes[1], width, height, {&red_green, 1}, pixels_per_degree),
           see(image.planes[2], width, height, blue_yellow, pixels_per_degree)}};
}

/// L*a*b* whose chroma counts for less in the dark: the Hunt effect (4.1).
Triple hunt_lab(const Triple& linear) {
  const Triple lab = cie::xyz_to_lab(cie::rgb_to_xyz(linear));
  return {lab[0], 0.01 * lab[0] * lab[1], 0.01 * lab[0] * lab[2]};
}

/// Filters overshoot: what no display can show is clamped.
Triple hunt_lab_of_opponent(const Triple& opponent) {
  Triple linear = cie::xyz_to_rgb(cie::opponent_to_xyz(opponent));
  for (double& c : linear) c = std::clamp(c, 0.0, 1.0);
  return hunt_lab(linear);
}

/// HyAB (Abasi, Tehran and Fairchild 2020): city-block in lightness, Euclidean in chroma, for large differences.
double hyab(const Triple& p, const Triple& q) {
  return std::abs(p[0] - q[0]) + std::hypot(p[1] - q[1], p[2] - q[2]);
}

/// The colour difference in [0, 1] (4.1): compressed, its largest value that of green against blue.
double color_difference(const Triple& reference, const Triple& test) {
  static const double largest = std::pow(hyab(hunt_lab({0.0, 1.0, 0.0}), hunt_lab({0.0, 0.0, 1.0})), color_exponent);
  const double difference = std::pow(hyab(hunt_lab_of_opponent(reference), hunt_lab_of_opponent(test)), color_exponent);
  const double knee = knee_of_range * largest;
  if (difference < knee) return knee_of_result / knee * difference;
  return knee_of_result + (difference - knee) / (largest - knee) * (1.0 - knee_of_result);
}

// ---- features: edges and points that one image has and the other has not (4.2)

/// Positive weights that sum to 1 and negative ones that sum to -1.
void balance(Kernel& kernel) {
  double positive = 0.0, negative = 0.0;
  for (const double weight : kernel) (weight > 0.0 ? positive : negative) += weight;
  for (double& weight : kernel) weight /= weight > 0.0 ? positive : -negative;
}

struct Detectors {
  Kernel smooth, edge, point;  ///< a Gaussian, its first and its second derivative

  explicit Detectors(double pixels_per_degree) {
    const double sigma = 0.5 * feature_width_deg * pixels_per_degree;
    const int radius = int(std::ceil(3.0 * sigma));
    smooth = gaussian_kernel(sigma, radius);
    for (int x = -radius; x <= radius; ++x) {
      const double g = std::exp(-0.5 * x * x / (sigma * sigma));
      edge.push_back(-x * g);
      point.push_back((x * x / (sigma * sigma) - 1.0) * g);
    }
    balance(edge);
    balance(point);
  }
};

/// The length of the detector's two responses, along x and along y.
Plane responses(const Plane& plane, int width_px, int height_px, const Kernel& detector, const Kernel& smooth) {
  Plane lengths = filter(plane, width_px, height_px, detector, smooth);
  const Plane along_y = filter(plane, width_px, height_px, smooth, detector);
  std::transform(lengths.begin(), lengths.end(), along_y.begin(), lengths.begin(),
                 [](float x, float y) { return std::hypot(x, y); });
  return lengths;
}

/// The luminance in [0, 1].
Plane luminance_of(const Opponent& image) {
  Plane plane(image.size());
  std::transform(image.planes[0].begin(), image.planes[0].end(), plane.begin(),
                 [](float y) { return (y + 16.0f) / 116.0f; });
  return plane;
}

/// In [0, 1], of each pixel.
Plane feature_differences(const Opponent& reference, const Opponent& test, double pixels_per_degree) {
  const Detectors detectors(pixels_per_degree);
  const int width = reference.width_px, height = reference.height_px;
  const Plane a = luminance_of(reference), b = luminance_of(test);
  Plane largest(reference.size());
  for (const Kernel* detector : {&detectors.edge, &detectors.point}) {
    const Plane in_a = responses(a, width, height, *detector, detectors.smooth);
    const Plane in_b = responses(b, width, height, *detector, detectors.smooth);
    for (size_t i = 0; i < largest.size(); ++i) largest[i] = std::max(largest[i], std::abs(in_a[i] - in_b[i]));
  }
  for (float& value : largest) value = float(std::pow(double(value) / std::numbers::sqrt2, feature_exponent));
  return largest;
}

}  // namespace

std::vector<float> flip(const DisplayImage& reference, const DisplayImage& test, double pixels_per_degree) {
  if (reference.width_px != test.width_px || reference.height_px != test.height_px || reference.rgb[0].empty())
    throw std::logic_error("images to compare differ in size or are empty");
  const Opponent a = to_opponent(reference), b = to_opponent(test);
  const Plane features = feature_differences(a, b, pixels_per_degree);
  const Opponent seen_a = see(a, pixels_per_degree), seen_b = see(b, pixels_per_degree);
  Plane errors(features.size());
  // 4.3: where a feature differs, the colour difference counts for more.
  for (size_t i = 0; i < errors.size(); ++i)
    errors[i] = float(std::pow(color_difference(seen_a.at(i), seen_b.at(i)), 1.0 - double(features[i])));
  return errors;
}

}  // namespace izb
