// SPDX-License-Identifier: MIT
// What goes from the interface to the painter, and what comes back.
#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/frame_options.h"
#include "image/image.h"
#include "shadow/technique.h"
#include "view/light_space.h"
#include "view/looks.h"
#include "view/pixel_probe.h"
#include "view/snapshot.h"
#include "view/state.h"

namespace izb {

/// A picture that the interface asks for.
struct Request {
  uint64_t serial = 0;
  ViewState state;
  Size size{1280, 720};      ///< of the picture at full resolution
  bool motion = false;       ///< more requests are coming: a slow renderer may take a lower scale
  bool counts = false;       ///< of table 1, at rest
  bool light_space = false;  ///< lists and windows, for the grid's picture, frusta and picks
};

struct StageTime {
  std::string name;  ///< of the spine
  double ms;
};

/// One technique's part of a frame.
struct SidePicture {
  std::string technique, error;  ///< error: one sentence in place of the picture
  int spp = 0;
  std::shared_ptr<const Image8> picture;
  std::vector<uint32_t> mask;  ///< of the active light, top row first
  std::string mask_hash;       ///< at rest
  std::vector<StageTime> stages;
  double frame_ms = 0.0;
  Counts counts;
};

/// Immutable once the painter has published it.
struct Frame {
  uint64_t serial = 0;
  double scale = 1.0;
  bool motion = false;
  Size full{0, 0};  ///< at full resolution
  ViewState state;  ///< that it shows
  Camera camera;
  std::vector<Light> lights;
  std::array<std::optional<SidePicture>, 2> sides;  ///< those that are shown
  std::shared_ptr<const Image8> difference;         ///< of the sides' masks
  std::optional<LookPicture> look;                  ///< of the active side, at rest: of the screen or of the grid
  std::shared_ptr<const Snapshot> snapshot;         ///< of the active side, at rest
  std::shared_ptr<const Snapshot> light_space;      ///< the same, or as it was frozen
};

/// What is known of a scene when it has been loaded.
struct SceneFacts {
  std::string file;
  size_t triangles = 0;
  std::vector<std::string> cameras, lights, animations;  ///< as the command line names them
  double animation_length_s = 0.0;                       ///< of the longest
  double radius_ws = 1.0;
  glm::dvec3 center_ws{0.0};
  std::vector<std::string> ignored;
  FrameOptions frame;  ///< as asked, with a camera and a light by name or by numbers
  uint64_t load = 0;   ///< which Painter::load() asked for it
};

struct Message {
  bool error = false;
  std::string text;
  uint64_t load = 0;  ///< of which Painter::load(); 0: of none
};

/// The state of the shaders' text: as the program began, read again, or refused.
struct ShaderFlag {
  enum Color { white, green, red } color = white;
  std::string text;
};

}  // namespace izb
