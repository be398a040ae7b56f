// SPDX-License-Identifier: MIT
#include "image/cie.h"

#include <gtest/gtest.h>

namespace {

using izb::cie::Triple;

void expect_near(const Triple& found, const Triple& expected, double tolerance) {
  for (size_t i = 0; i < 3; ++i) EXPECT_NEAR(found[i], expected[i], tolerance) << i;
}

TEST(Cie, HasTheMatrixOfTheStandardButForItsRoundedWhite) {
  // IEC 61966-2-1 prints four digits; the Z of its white, (0.3127, 0.3290), is 1.6e-4 larger.
  constexpr double tolerance = 2e-4;
  expect_near(izb::cie::rgb_to_xyz({1, 0, 0}), {0.4124, 0.2126, 0.0193}, tolerance);
  expect_near(izb::cie::rgb_to_xyz({0, 1, 0}), {0.3576, 0.7152, 0.1192}, tolerance);
  expect_near(izb::cie::rgb_to_xyz({0, 0, 1}), {0.1805, 0.0722, 0.9505}, tolerance);
}

TEST(Cie, WhiteIsD65) {
  expect_near(izb::cie::rgb_to_xyz({1, 1, 1}), {0.950429, 1.0, 1.088900}, 1e-6);
}

TEST(Cie, WhiteAndBlackHaveNoColour) {
  const Triple white = izb::cie::rgb_to_xyz({1, 1, 1}), black{0, 0, 0};
  expect_near(izb::cie::xyz_to_lab(white), {100, 0, 0}, 1e-12);
  expect_near(izb::cie::xyz_to_opponent(white), {100, 0, 0}, 1e-12);
  expect_near(izb::cie::xyz_to_lab(black), {0, 0, 0}, 1e-12);
  expect_near(izb::cie::xyz_to_opponent(black), {-16, 0, 0}, 1e-12);
}

TEST(Cie, LabOfThePrimaries) {
  // Known to two digits, e.g. from colour charts: sRGB red, green and blue under D65.
  expect_near(izb::cie::xyz_to_lab(izb::cie::rgb_to_xyz({1, 0, 0})), {53.24, 80.09, 67.20}, 0.02);
  expect_near(izb::cie::xyz_to_lab(izb::cie::rgb_to_xyz({0, 1, 0})), {87.73, -86.18, 83.18}, 0.02);
  expect_near(izb::cie::xyz_to_lab(izb::cie::rgb_to_xyz({0, 0, 1})), {32.30, 79.19, -107.86}, 0.02);
}

TEST(Cie, GoesBack) {
  const Triple color{0.2, 0.7, 0.05};
  expect_near(izb::cie::xyz_to_rgb(izb::cie::rgb_to_xyz(color)), color, 1e-14);
  expect_near(izb::cie::opponent_to_xyz(izb::cie::xyz_to_opponent(color)), color, 1e-14);
}

}  // namespace
