// SPDX-License-Identifier: MIT
// izb_loading FILE.glb: how long loading takes, beside the least that it could: reading the file's bytes and building
// its arrays by a plain copy loop. Both in one run, by turns; medians.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <fstream>
#include <vector>

#include "base/error.h"
#include "scene/gltf.h"

namespace {

using Clock = std::chrono::steady_clock;

double ms_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

/// All bytes of the file, copied once more, value by value, into arrays of as many words.
double read_and_copy_ms(const char* path) {
  const Clock::time_point start = Clock::now();
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  std::vector<char> bytes(static_cast<size_t>(file.tellg()));
  file.seekg(0);
  file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  std::vector<uint32_t> words(bytes.size() / sizeof(uint32_t));
  for (size_t i = 0; i < words.size(); ++i) std::memcpy(&words[i], &bytes[i * sizeof(uint32_t)], sizeof(uint32_t));
  const double ms = ms_since(start);
  volatile uint32_t kept = words.empty() ? 0 : words[words.size() / 2];  // so that the loop is not left out
  (void)kept;
  return ms;
}

double load_ms(const char* path, size_t& triangles) {
  const Clock::time_point start = Clock::now();
  const izb::Scene scene = izb::load_gltf(path);
  triangles = scene.triangle_count();
  return ms_since(start);
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

}  // namespace

int main(int count, char** words) {
  if (count != 2) {
    fmt::print(stderr, "usage: izb_loading FILE.glb\n");
    return 2;
  }
  try {
    size_t triangles = 0;
    std::vector<double> copies_ms, loads_ms;
    load_ms(words[1], triangles);  // the file is in the system's cache from here on
    for (int i = 0; i < 7; ++i) {
      copies_ms.push_back(read_and_copy_ms(words[1]));
      loads_ms.push_back(load_ms(words[1], triangles));
    }
    const double copy_ms = median(copies_ms), loading_ms = median(loads_ms);
    fmt::print("{} triangles: read and copy {:.0f} ms, load {:.0f} ms, ratio {:.2f}\n", triangles, copy_ms, loading_ms,
               loading_ms / copy_ms);
  } catch (const izb::Error& e) {
    fmt::print(stderr, "izb_loading: {}\n", e.what());
    return 1;
  }
  return 0;
}
