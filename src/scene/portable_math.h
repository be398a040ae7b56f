// SPDX-License-Identifier: MIT
// Sines, cosines and the like with the same bits on every machine: the C library's may differ in the last one. Only
// operations that IEEE 754 rounds correctly are used (and no contraction, which the build turns off).
#pragma once
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>

namespace izb {

namespace portable {

/// 1 - y / (k (k + 1)) + y^2 / (k (k + 1) (k + 2) (k + 3)) - ...: Taylor's series of cos for k = 1 and of sin(x) / x
/// for k = 2, y = x^2. For x in [-pi/4, pi/4] the first term left out is below 1e-19.
inline double taylor_series(double y, int k) {
  double term = 1.0, sum = 1.0;
  for (int n = k; n <= 19; n += 2) {
    term *= -y / (n * (n + 1));
    sum += term;
  }
  return sum;
}

inline double sine_near_0(double x) {
  return x * taylor_series(x * x, 2);
}

inline double cosine_near_0(double x) {
  return taylor_series(x * x, 1);
}

}  // namespace portable

/// (cos x, sin x); for |x| up to some 10^5 within a few units in the last place.
inline glm::dvec2 on_circle(double x) {
  // pi/2 in two parts, the first with so few bits that its multiples are exact.
  constexpr double half_pi_high = 1.57079632673412561417, half_pi_low = 6.07710050650619224932e-11;
  const double quarter = std::floor(x / (0.5 * std::numbers::pi) + 0.5);
  const double rest = (x - quarter * half_pi_high) - quarter * half_pi_low;
  const double s = portable::sine_near_0(rest), c = portable::cosine_near_0(rest);
  const double turn = quarter - 4.0 * std::floor(quarter / 4.0);
  if (turn == 0.0) return {c, s};
  if (turn == 1.0) return {-s, c};
  if (turn == 2.0) return {-c, -s};
  return {s, -c};
}

inline double cosine(double x) {
  return on_circle(x).x;
}

inline double sine(double x) {
  return on_circle(x).y;
}

}  // namespace izb
