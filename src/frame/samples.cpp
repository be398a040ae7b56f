// SPDX-License-Identifier: MIT
#include "frame/samples.h"

#include <cmath>
#include <sstream>

#include "base/error.h"
#include "base/file.h"

namespace izb {
namespace {

/// The digits of i in `base`, mirrored at the point (van der Corput).
double radical_inverse(unsigned i, unsigned base) {
  double value = 0.0, digit = 1.0 / base;
  for (; i > 0; i /= base, digit /= base) value += digit * (i % base);
  return value;
}

glm::vec2 from_unit_square(double x, double y) {
  return {static_cast<float>(x - 0.5), static_cast<float>(y - 0.5)};
}

}  // namespace

SamplePattern center_sample() {
  return {"center", {glm::vec2(0.0f)}};
}

SamplePattern halton_samples() {
  SamplePattern pattern{"halton", {}};
  for (unsigned i = 1; i <= samples_a_word; ++i)
    pattern.offsets_px.push_back(from_unit_square(radical_inverse(i, 2), radical_inverse(i, 3)));
  return pattern;
}

SamplePattern hammersley_samples() {
  SamplePattern pattern{"hammersley", {}};
  for (unsigned i = 0; i < samples_a_word; ++i)
    pattern.offsets_px.push_back(
        from_unit_square((i + 0.5) / samples_a_word, radical_inverse(i, 2) + 0.5 / samples_a_word));
  return pattern;
}

SamplePattern read_samples(const std::string& path) {
  std::istringstream file(read_text_file(path));
  SamplePattern pattern{path, {}};
  std::string line;
  for (int number = 1; std::getline(file, line); ++number) {
    std::istringstream words(line.substr(0, line.find('#')));
    words >> std::ws;
    if (words.eof()) continue;
    glm::vec2 p;
    std::string more;
    if (!(words >> p.x >> p.y) || words >> more || !(std::abs(p.x) <= 0.5f) || !(std::abs(p.y) <= 0.5f))
      fail("sample pattern '{}', line {}: two numbers between -0.5 and 0.5 are expected", path, number);
    pattern.offsets_px.push_back(p);
  }
  if (pattern.count() != samples_a_word)
    fail("sample pattern '{}' has {} samples; {} are needed", path, pattern.count(), samples_a_word);
  return pattern;
}

glm::dvec2 pixel_shift(uint32_t frame) {
  constexpr uint32_t half = 1u << 31;
  uint32_t x = half, y = half;  // the shift: 0 becomes the centre
  uint32_t x_direction = half, y_direction = half;
  for (uint32_t digits = frame; digits != 0; digits >>= 1) {
    if (digits & 1u) x ^= x_direction, y ^= y_direction;
    x_direction >>= 1;
    y_direction ^= y_direction >> 1;
  }
  return glm::dvec2(x, y) * 0x1p-32 - 0.5;
}

void SampleOptions::declare(OptionSet& set) {
  set.choice("spp", spp, {"1", "32"}, "shadow samples a pixel");
  set.text("samples", pattern, "PATTERN|FILE",
           "where the 32 samples lie: hammersley, halton (the paper's), or a file of 32 lines 'x y' in pixels from the "
           "centre, -0.5 to 0.5");
  set.choice("micro-quad", micro_quad, {"lifted", "tangent"},
             "where the plane of the 32 samples lies: on the triangle that the pixel's centre sees (tangent, the "
             "paper's), or as far above as the surface bends up within the pixel");
}

SamplePattern SampleOptions::samples() const {
  if (spp == "1") return center_sample();
  SamplePattern samples = pattern == "hammersley" ? hammersley_samples()
                          : pattern == "halton"   ? halton_samples()
                                                  : read_samples(pattern);
  samples.lifted = micro_quad == "lifted";
  return samples;
}

}  // namespace izb
