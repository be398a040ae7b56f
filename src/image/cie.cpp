// SPDX-License-Identifier: MIT
#include "image/cie.h"

#include <cmath>

namespace izb::cie {
namespace {

/// Row after row.
using Matrix = std::array<Triple, 3>;

Triple operator*(const Matrix& m, const Triple& v) {
  Triple out{};
  for (size_t r = 0; r < 3; ++r) out[r] = m[r][0] * v[0] + m[r][1] * v[1] + m[r][2] * v[2];
  return out;
}

Triple cross(const Triple& a, const Triple& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Matrix inverse(const Matrix& m) {
  const Triple columns[] = {cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1])};
  const double determinant = m[0][0] * columns[0][0] + m[0][1] * columns[0][1] + m[0][2] * columns[0][2];
  Matrix out{};
  for (size_t r = 0; r < 3; ++r)
    for (size_t c = 0; c < 3; ++c) out[r][c] = columns[c][r] / determinant;
  return out;
}

/// The colour of chromaticity (x, y) whose Y is 1.
Triple from_chromaticity(double x, double y) {
  return {x / y, 1.0, (1.0 - x - y) / y};
}

struct Srgb {
  Triple white = from_chromaticity(0.31271, 0.32902);
  Matrix xyz_from_rgb{}, rgb_from_xyz{};

  Srgb() {
    const Triple primaries[] = {from_chromaticity(0.64, 0.33), from_chromaticity(0.30, 0.60),
                                from_chromaticity(0.15, 0.06)};
    for (size_t r = 0; r < 3; ++r)
      for (size_t c = 0; c < 3; ++c) xyz_from_rgb[r][c] = primaries[c][r];
    const Triple luminances = inverse(xyz_from_rgb) * white;
    for (Triple& row : xyz_from_rgb)
      for (size_t c = 0; c < 3; ++c) row[c] *= luminances[c];
    rgb_from_xyz = inverse(xyz_from_rgb);
  }
};

const Srgb srgb;

Triple relative_to_white(const Triple& xyz) {
  return {xyz[0] / srgb.white[0], xyz[1] / srgb.white[1], xyz[2] / srgb.white[2]};
}

double lab_curve(double t) {
  constexpr double delta = 6.0 / 29.0;
  return t > delta * delta * delta ? std::cbrt(t) : t / (3.0 * delta * delta) + 4.0 / 29.0;
}

}  // namespace

Triple rgb_to_xyz(const Triple& linear) {
  return srgb.xyz_from_rgb * linear;
}

Triple xyz_to_rgb(const Triple& xyz) {
  return srgb.rgb_from_xyz * xyz;
}

Triple xyz_to_opponent(const Triple& xyz) {
  const Triple w = relative_to_white(xyz);
  return {116.0 * w[1] - 16.0, 500.0 * (w[0] - w[1]), 200.0 * (w[1] - w[2])};
}

Triple opponent_to_xyz(const Triple& opponent) {
  const double y = (opponent[0] + 16.0) / 116.0;
  return {(y + opponent[1] / 500.0) * srgb.white[0], y * srgb.white[1], (y - opponent[2] / 200.0) * srgb.white[2]};
}

Triple xyz_to_lab(const Triple& xyz) {
  const Triple w = relative_to_white(xyz);
  const double fx = lab_curve(w[0]), fy = lab_curve(w[1]), fz = lab_curve(w[2]);
  return {116.0 * fy - 16.0, 500.0 * (fx - fy), 200.0 * (fy - fz)};
}

}  // namespace izb::cie
