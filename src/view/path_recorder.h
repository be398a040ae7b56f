// SPDX-License-Identifier: MIT
// A camera path as a person flies it.
#pragma once
#include <string>

#include "scene/camera_path.h"
#include "view/camera_control.h"

namespace izb {

class PathRecorder {
 public:
  /// A key now, unless the one before is younger than `interval_s`; times count from the first.
  void add(double now_s, const CameraPose& pose, double interval_s = 0.25);
  /// The last key, however young the one before is. Throws std::logic_error if there is none.
  void end(double now_s, const CameraPose& pose);
  bool empty() const { return path_.keys.empty(); }
  const CameraPath& path() const { return path_; }

 private:
  CameraPath path_;
  double start_s_ = 0.0;
};

/// As read_camera_path() reads it.
std::string camera_path_json(const CameraPath& path);

}  // namespace izb
