// SPDX-License-Identifier: MIT
// The frames of an animation: their numbers, moments and file names, and which of them are rendered already.
#pragma once
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "base/options.h"

namespace izb {

struct SequenceOptions {
  std::string frames;
  double fps = 30.0;
  bool resume = false;

  void declare(OptionSet& set);
};

/// First and last frame, both included.
struct FrameRange {
  int first = 0, last = 0;
};

/// From `--frames FIRST:LAST`, or a single number; nothing where no frames are asked for. Throws izb::UsageError.
std::optional<FrameRange> frame_range(const SequenceOptions& options);

/// The name of one frame's file: a run of # in `path` becomes the number with at least as many digits; without one, the
/// number of four digits comes before the extension. Empty for an empty path.
std::string numbered(const std::string& path, int frame);

/// What a frame's file, an OpenEXR or JSON one, says of itself: at least `options`, `scene` and of a supersampled frame
/// `supersample` and `exposure`, where it was rendered with the same options of the same scene, but for how many frames
/// it is the mean of; null where it does not exist. `facts` are the frame's own. Throws izb::Error where there is a
/// file of other options.
nlohmann::json rendered_facts(const std::string& path, const nlohmann::json& facts);

/// Whether `path` is such a file and, if supersampled, the mean of as many frames.
bool is_rendered(const std::string& path, const nlohmann::json& facts);

}  // namespace izb
