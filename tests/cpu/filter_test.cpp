// SPDX-License-Identifier: MIT
#include "image/filter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>

namespace {

using Plane = std::vector<double>;

TEST(Filter, IsTheSumOfItsTapsWithTheBordersValuesBeyond) {
  constexpr int width = 5, height = 4;
  Plane plane(width * height);
  for (size_t i = 0; i < plane.size(); ++i) plane[i] = double((i * 7) % 11);
  const izb::Kernel along_x{1, 2, 3, -1, 5}, along_y{2, 0, -3};
  const Plane out = izb::filter(plane, width, height, along_x, along_y);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      double sum = 0.0;
      for (int j = -1; j <= 1; ++j)
        for (int i = -2; i <= 2; ++i)
          sum += along_x[size_t(i + 2)] * along_y[size_t(j + 1)] *
                 plane[size_t(std::clamp(y + j, 0, height - 1) * width + std::clamp(x + i, 0, width - 1))];
      EXPECT_DOUBLE_EQ(out[size_t(y * width + x)], sum) << x << ", " << y;
    }
}

TEST(Filter, LeavesAPlainPlaneAlone) {
  const izb::Kernel kernel = izb::gaussian_kernel(2.0, 6);
  EXPECT_EQ(kernel.size(), 13u);
  EXPECT_NEAR(std::accumulate(kernel.begin(), kernel.end(), 0.0), 1.0, 1e-15);
  for (const float value : izb::filter(std::vector<float>(12, 0.7f), 4, 3, kernel, kernel))
    EXPECT_FLOAT_EQ(value, 0.7f);
}

TEST(Filter, WrongSizesAreBugs) {
  EXPECT_THROW(izb::filter(Plane(5), 2, 2, {1}, {1}), std::logic_error);
  EXPECT_THROW(izb::filter(Plane(), 0, 0, {1}, {1}), std::logic_error);
  EXPECT_THROW(izb::filter(Plane(4), 2, 2, {1, 1}, {1}), std::logic_error);
}

}  // namespace
