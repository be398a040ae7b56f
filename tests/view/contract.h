// SPDX-License-Identifier: MIT
// What the tests take from the viewer beyond docs/VIEW.md: names within its state, and labels of its widgets.
#pragma once
#include <nlohmann/json.hpp>
#include <string>

namespace izb::test {

inline nlohmann::json camera_of(const nlohmann::json& state) {
  const nlohmann::json& frame = state.at("frame");
  return {frame.at("camera"), frame.at("eye"), frame.at("target"), frame.at("fov"), frame.at("camera-path")};
}
inline nlohmann::json lights_of(const nlohmann::json& state) {
  const nlohmann::json& frame = state.at("frame");
  return {frame.at("light"),          frame.at("sun"), frame.at("spot"), frame.at("point"), frame.at("light-position"),
          frame.at("light-direction")};
}
/// The name of the shown view of a stage; empty: the picture.
inline std::string view_of(const nlohmann::json& state) {
  return state.at("look");
}
/// off, split, flicker, difference
inline std::string compare_of(const nlohmann::json& state) {
  return state.at("compare");
}
/// Moment of the animation in seconds.
inline double time_of(const nlohmann::json& state) {
  return state.at("frame").at("time");
}

/// The button that ends the hints of the first start for good.
inline constexpr const char* dismiss_hints = "do not show them again";
/// The button of the help's window.
inline constexpr const char* close_help = "close help";

/// What a click on it may end the program, or wait for a person.
inline bool is_left_alone(const std::string& label) {
  for (const char* word : {"save", "load"})
    if (label.find(word) != std::string::npos) return true;
  return false;
}

}  // namespace izb::test
