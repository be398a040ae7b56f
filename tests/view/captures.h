// SPDX-License-Identifier: MIT
// What two pictures of a window have in common.
#pragma once
#include <cmath>
#include <cstdlib>

#include "image/image.h"
#include "view/x_display.h"

namespace izb::test {

struct Rect {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;  ///< the last ones outside
};

/// The middle of a window, which bars at its edges leave free.
inline Rect middle_of(const Image8& picture) {
  const int w = picture.width_px, h = picture.height_px;
  return {w * 15 / 100, h * 15 / 100, w * 85 / 100, h * 85 / 100};
}

inline const uint8_t* pixel(const Image8& picture, Point p) {
  return &picture.pixels[(size_t(p.y) * size_t(picture.width_px) + size_t(p.x)) * 3];
}

inline int difference(const uint8_t* a, const uint8_t* b) {
  return std::abs(a[0] - b[0]) + std::abs(a[1] - b[1]) + std::abs(a[2] - b[2]);
}

/// Pixels of `where` that differ; pictures of unlike size differ everywhere.
inline size_t changed(const Image8& a, const Image8& b, const Rect& where) {
  const bool alike = a.width_px == b.width_px && a.height_px == b.height_px;
  size_t count = 0;
  for (int y = where.y0; y < where.y1; ++y)
    for (int x = where.x0; x < where.x1; ++x) count += !alike || difference(pixel(a, {x, y}), pixel(b, {x, y})) > 0;
  return count;
}

inline bool is_flat(const Image8& picture, const Rect& where) {
  for (int y = where.y0; y < where.y1; ++y)
    for (int x = where.x0; x < where.x1; ++x)
      if (difference(pixel(picture, {x, y}), pixel(picture, {where.x0, where.y0})) > 0) return false;
  return true;
}

/// By which of 1, 2, 4, ..., 32 `shown` magnifies `original` around `centre`: the one that explains its pixels best.
inline int magnification(const Image8& original, const Image8& shown, Point centre, int radius_px = 24) {
  int best = 1;
  double least = 1e300;
  for (int m = 1; m <= 32; m *= 2)
    for (int shift_y = -m; shift_y <= m; ++shift_y)  // where within its pixel the centre lies is the lens's affair
      for (int shift_x = -m; shift_x <= m; ++shift_x) {
        double error = 0.0;
        const auto source = [&](int c, int d, int shift) { return c + int(std::floor(double(d + shift) / m)); };
        for (int y = -radius_px; y < radius_px; ++y)
          for (int x = -radius_px; x < radius_px; ++x)
            error += difference(pixel(shown, {centre.x + x, centre.y + y}),
                                pixel(original, {source(centre.x, x, shift_x), source(centre.y, y, shift_y)}));
        if (error < least) {
          least = error;
          best = m;
        }
      }
  return best;
}

}  // namespace izb::test
