// SPDX-License-Identifier: MIT
#include "view/color_scale.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "image/heat_map.h"

namespace izb {
namespace {

constexpr double rest = 1.0 / 200.0;  // of the values may lie outside a scale, at either end

/// Hue in turns.
Rgb from_hsv(float hue, float saturation, float value) {
  const auto component = [&](float n) {
    const float k = std::fmod(n + 6.0f * hue, 6.0f);
    const float c = value * (1.0f - saturation * std::clamp(std::min(k, 4.0f - k), 0.0f, 1.0f));
    return static_cast<uint8_t>(std::lround(255.0f * c));
  };
  return {component(5.0f), component(3.0f), component(1.0f)};
}

/// Of a set of a few values the outermost.
float quantile(std::vector<float>& values, double share) {
  const double at = share * double(values.size() - 1);
  const auto nth = values.begin() + ptrdiff_t(share > 0.5 ? std::ceil(at) : std::floor(at));
  std::nth_element(values.begin(), nth, values.end());
  return *nth;
}

double power_of_ten_below(float x) {
  return std::pow(10.0, std::floor(std::log10(double(x))));
}

}  // namespace

Rgb distinct_color(uint32_t number) {
  constexpr double golden = 0.61803398875;
  return from_hsv(float(std::fmod(0.58 + golden * number, 1.0)), number / 3 % 2 == 0 ? 0.75f : 0.45f, 0.95f);
}

Rgb hashed_color(uint32_t number) {
  uint32_t h = number * 0x9e3779b9u + 0x7f4a7c15u;
  h = (h ^ (h >> 16)) * 0x85ebca6bu;
  h = (h ^ (h >> 13)) * 0xc2b2ae35u;
  h ^= h >> 16;
  const auto part = [&](int shift) { return float(h >> shift & 0xffu) / 256.0f; };
  return from_hsv(part(0), 0.35f + 0.5f * part(8), 0.5f + 0.45f * part(16));
}

Rgb dimmed(const Rgb& color, float share) {
  Rgb result;
  for (size_t k = 0; k < 3; ++k) result[k] = static_cast<uint8_t>(std::lround(float(color[k]) * share));
  return result;
}

// The factors meet numbers that are nice but for their rounding.
float nice_above(float x) {
  const double power = power_of_ten_below(x);
  for (const double digit : {1.0, 2.0, 5.0})
    if (double(x) <= digit * power * 1.00001) return float(digit * power);
  return float(10.0 * power);
}

float nice_below(float x) {
  const double power = power_of_ten_below(x);
  for (const double digit : {10.0, 5.0, 2.0})
    if (double(x) >= digit * power * 0.99999) return float(digit * power);
  return float(power);
}

Rgb ColorScale::color(float value) const {
  if (!logarithmic) return heat_color((value - low) / (high - low));
  return heat_color(std::log(value / low) / std::log(high / low));
}

ColorScale scale_of(std::vector<float> values) {
  if (values.empty()) return {};
  const float most = quantile(values, 1.0 - rest);
  return {0.0f, most > 0.0f ? nice_above(most) : 1.0f, false};
}

ColorScale log_scale_of(std::vector<float> values) {
  if (values.empty()) return {1.0f, 10.0f, true};
  const float low = nice_below(quantile(values, rest));
  return {low, std::max(nice_above(quantile(values, 1.0 - rest)), nice_above(1.5f * low)), true};
}

std::string with_unit(float value, const char* unit) {
  return fmt::format("{:g} {}", value, unit);
}

Image8 blank(int width_px, int height_px) {
  Image8 picture{width_px, height_px, 3, {}};
  const size_t count = size_t(width_px) * size_t(height_px);
  picture.pixels.resize(3 * count);
  for (size_t i = 0; i < count; ++i) put(picture, i, nothing_color);
  return picture;
}

}  // namespace izb
