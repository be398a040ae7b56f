// SPDX-License-Identifier: MIT
#include "scene/procedural/fit.h"

#include <cmath>

namespace izb::procedural {

Scene fitted(const char* name, void (*build)(Builder&), uint32_t seed, size_t triangles, size_t usual) {
  const double wanted = double(triangles);
  double best = 1.0, best_miss = 1e300;
  const auto ratio_at = [&](double detail) {  // of the number to the one wanted
    Builder counter{name, seed, detail, true};
    build(counter);
    const double ratio = double(counter.triangle_count()) / wanted;
    const double miss = ratio > 1.0 ? ratio - 1.0 : 1.0 / ratio - 1.0;
    if (miss < best_miss) best_miss = miss, best = detail;
    return ratio;
  };
  constexpr double close_enough = 0.003, step = 1.25;
  // Triangles grow about with the square of detail; from there, a bracket that closes.
  double low = std::sqrt(wanted / double(usual)), high = low;
  if (ratio_at(low) > 1.0)
    for (int i = 0; i < 40 && best_miss > close_enough && ratio_at(low /= step) > 1.0; ++i) high = low;
  else
    for (int i = 0; i < 40 && best_miss > close_enough && ratio_at(high *= step) <= 1.0; ++i) low = high;
  for (int i = 0; i < 24 && best_miss > close_enough; ++i) {
    const double middle = std::sqrt(low * high);
    (ratio_at(middle) > 1.0 ? high : low) = middle;
  }
  Builder builder{name, seed, best, false};
  build(builder);
  return builder.finish();
}

}  // namespace izb::procedural
