// SPDX-License-Identifier: MIT
#include "image/heat_map.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "image/srgb.h"

namespace izb {
namespace {

using Rgb = std::array<float, 3>;

/// OKLab to linear sRGB, possibly outside the gamut (Björn Ottosson, "A perceptual color space for image
/// processing", 2020).
Rgb oklab_to_linear(float L, float a, float b) {
  const float l = L + 0.3963377774f * a + 0.2158037573f * b;
  const float m = L - 0.1055613458f * a - 0.0638541728f * b;
  const float s = L - 0.0894841775f * a - 1.2914855480f * b;
  const float l3 = l * l * l, m3 = m * m * m, s3 = s * s * s;
  return {4.0767416621f * l3 - 3.3077115913f * m3 + 0.2309699292f * s3,
          -1.2684380046f * l3 + 2.6097574011f * m3 - 0.3413193965f * s3,
          -0.0041960863f * l3 - 0.7034186147f * m3 + 1.7076147010f * s3};
}

bool displayable(const Rgb& linear) {
  return std::all_of(linear.begin(), linear.end(), [](float c) { return c >= 0.0f && c <= 1.0f; });
}

/// Lightness rises linearly, the hue turns from violet by way of red to yellow, and the chroma is as strong
/// as the display can show, up to a limit.
Rgb scale_color(float t) {
  constexpr float degree = 0.01745329252f, strongest = 0.17f;
  const float lightness = 0.20f + 0.76f * t;
  const float hue = (-75.0f + 180.0f * t) * degree;
  float chroma = strongest;
  Rgb linear{};
  do {
    linear = oklab_to_linear(lightness, chroma * std::cos(hue), chroma * std::sin(hue));
    chroma -= 0.002f;
  } while (!displayable(linear) && chroma > 0.0f);
  return linear;
}

}  // namespace

std::array<uint8_t, 3> heat_color(float value) {
  static const auto table = [] {
    std::array<std::array<uint8_t, 3>, 256> colors{};
    for (size_t i = 0; i < colors.size(); ++i) {
      const Rgb linear = scale_color(float(i) / float(colors.size() - 1));
      std::transform(linear.begin(), linear.end(), colors[i].begin(), to_srgb8);
    }
    return colors;
  }();
  if (std::isnan(value)) return {0, 128, 128};
  return table[size_t(std::lround(255.0f * std::clamp(value, 0.0f, 1.0f)))];
}

Image8 heat_map(std::span<const float> values, int width_px, int height_px, float max_value) {
  if (values.size() != size_t(width_px) * size_t(height_px)) throw std::logic_error("a heat map has the wrong size");
  if (!(max_value > 0.0f)) throw std::logic_error("a heat map's largest value is not positive");
  Image8 picture{width_px, height_px, 3, {}};
  picture.pixels.reserve(3 * values.size());
  for (const float value : values) {
    const std::array<uint8_t, 3> color = heat_color(value / max_value);
    picture.pixels.insert(picture.pixels.end(), color.begin(), color.end());
  }
  return picture;
}

}  // namespace izb
