// SPDX-License-Identifier: MIT
// All that the viewer shows is a function of this: plain data, as a file keeps it and as the batch program's command
// line says it.
#pragma once
#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "app/frame_options.h"

namespace izb {

/// A technique and its options: what one side of a comparison shows.
struct SideState {
  std::string technique = "izb";
  nlohmann::json options = nlohmann::json::object();  ///< all values, under the options' names

  /// The technique with the defaults, or with a preset. Throws izb::UsageError for an unknown name of either.
  static SideState of(const std::string& technique, const std::string& preset = {});
  /// An object that has these options. Throws izb::UsageError as Option::set does, and for a name it does not have.
  std::unique_ptr<Technique> make() const;

  bool operator==(const SideState&) const = default;
};

enum class Compare { off, split, flicker, difference };

struct ViewState {
  std::string scene;   ///< a .gltf or .glb file
  FrameOptions frame;  ///< camera, lights, moment; size and technique stand elsewhere
  std::array<SideState, 2> sides;
  int active = 0;      ///< of the sides: the one that options change, and that is shown alone
  bool truth = false;  ///< the other side shows the ray-traced truth of the same frame
  Compare compare = Compare::off;
  double split = 0.5;  ///< where the bar stands, as a share of the width
  std::string look;    ///< of a stage (looks.h); empty: the picture
  int layer = 0;       ///< of the light-space grid, for looks of it
  int active_light = 0;
  bool lens = false;
  int lens_power = 8;  ///< 2 to 32
  bool frozen = false;
  bool frusta = false;               ///< the cascades are drawn as frusta
  std::optional<glm::ivec2> picked;  ///< the pixel that is looked at, from the upper left at full resolution

  int other() const { return 1 - active; }

  nlohmann::json to_json() const;
  /// Throws izb::Error that says which entry is wrong.
  static ViewState from_json(const nlohmann::json& json);
};

const char* name(Compare compare);

/// The words after "izb" that make the picture of one side with the batch program, without where it goes.
std::vector<std::string> batch_arguments(const ViewState& state, int side, Size size);

/// "izb render SCENE ...": the same for a shell.
std::string batch_command(const ViewState& state, int side, Size size);

}  // namespace izb
