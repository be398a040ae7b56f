// SPDX-License-Identifier: MIT
// The image pairs of tests/cpu/metrics, whose errors other programs have measured.
#pragma once
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "image/display.h"

namespace izb::test {

struct KnownPair {
  std::string name;
  DisplayImage reference, test;
  nlohmann::json expected;  ///< an entry of expected.json
};

inline std::string metric_file(const std::string& name) {
  return IZB_SOURCE_DIR "/tests/cpu/metrics/" + name;
}

inline std::vector<KnownPair> known_pairs() {
  std::vector<KnownPair> pairs;
  for (const nlohmann::json& expected : nlohmann::json::parse(std::ifstream(metric_file("expected.json")))) {
    const std::string name = expected["pair"];
    pairs.push_back({name, to_display(read_image(metric_file(name + "_reference.png"))),
                     to_display(read_image(metric_file(name + "_test.png"))), expected});
  }
  return pairs;
}

/// One colour everywhere.
inline DisplayImage plain(int width_px, int height_px, float r, float g, float b) {
  const auto count = size_t(width_px) * size_t(height_px);
  return {
      width_px, height_px, {std::vector<float>(count, r), std::vector<float>(count, g), std::vector<float>(count, b)}};
}

}  // namespace izb::test
