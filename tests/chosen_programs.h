// SPDX-License-Identifier: MIT
#pragma once
#include <cstdlib>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "shadow/renderer.h"

namespace izb::test {

/// Of all programs of the renderer so many that each define of each set of files is in one; with $IZB_FULL all, which
/// takes compilers minutes.
inline std::vector<gpu::ProgramSpec> chosen_programs() {
  const bool all = std::getenv("IZB_FULL");
  std::vector<gpu::ProgramSpec> chosen;
  std::set<std::pair<std::vector<std::string>, std::pair<std::string, std::string>>> seen;
  for (gpu::ProgramSpec& spec : Renderer::program_specs()) {
    bool is_new = seen.insert({spec.files, {}}).second;
    for (const auto& define : spec.defines) is_new |= seen.insert({spec.files, define}).second;
    if (all || is_new) chosen.push_back(std::move(spec));
  }
  return chosen;
}

}  // namespace izb::test
