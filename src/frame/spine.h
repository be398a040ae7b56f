// SPDX-License-Identifier: MIT
// The six stages of the paper (5.1 to 5.6), one word each. The same word is the shader file, the debug group, the
// timer, the JSON and CSV key, and the heading in the docs.
#pragma once
#include <array>

namespace izb {

enum class Stage { gbuffer, bounds, build, zcull, visibility, shade };

inline constexpr std::array<const char*, 6> stage_names{"gbuffer", "bounds", "build", "zcull", "visibility", "shade"};

/// Before them, and none of the paper's: the vertices of meshes that deform. Absent where there are none.
inline constexpr const char* deform_name = "deform";

/// Before `build`, and none of the paper's: izb's occlusion prepass. Absent where it is off.
inline constexpr const char* occluders_name = "occluders";

/// After them, of supersampled frames only.
inline constexpr const char* accumulate_name = "accumulate";

inline constexpr const char* name(Stage stage) {
  return stage_names[static_cast<size_t>(stage)];
}

}  // namespace izb
