// SPDX-License-Identifier: MIT
// A context, a scene, a technique and a renderer, made from the command line.
#pragma once
#include <memory>

#include "app/rendered_frame.h"

namespace izb {

/// The technique named on the command line, made before parsing so that its options can be parsed too.
std::unique_ptr<Technique> technique_of(const std::vector<std::string>& arguments);

/// Whether the scene's animations move it: a camera path alone may have moments, too.
bool animates(const FrameOptions& options, const Scene& scene);

/// Gives `to`, a technique of the same name, the values that the options of `from` have.
void copy_options(Technique& from, Technique& to);

/// Another of the same name, whose options have the same values.
std::unique_ptr<Technique> another(Technique& technique);

/// Everything for frames of one scene. The technique is its own, since GL objects must not outlive their context.
/// It stands at the options' --time.
struct Session {
  Session(const FrameOptions& options, std::unique_ptr<Technique> its_technique, const std::string& scene_path);
  /// Moves what is animated, the camera and the lights to another moment.
  void move_to(double time_s);
  RenderedFrame rendered() { return {scene, frame, gl, renderer, *technique, timers}; }

  Scene scene;
  Poser poser;
  AnimationMoment moment;
  bool plays;  ///< whether animations of the scene move it
  FrameChoice frame;
  Gl gl;
  std::unique_ptr<Technique> technique;
  Renderer renderer;
  gpu::StageTimers timers;

 private:
  void pose();
  FrameChoice choose_first_frame(const FrameOptions& options, const std::string& scene_path);
};

}  // namespace izb
