// SPDX-License-Identifier: MIT
// The configurations of a job side by side: one scene in one context, a renderer for each.
#pragma once
#include <chrono>
#include <list>
#include <memory>
#include <optional>

#include "app/bench/job.h"
#include "app/session.h"

namespace izb::bench {

/// One configuration, ready to render, or why it is not.
struct Subject {
  Subject(const Configuration& its, const FrameChoice& its_frame, bool wall_clock)
      : configuration(its), frame(its_frame), timers(wall_clock) {}

  const Configuration& configuration;
  FrameChoice frame;  ///< with the configuration's own size
  std::unique_ptr<Technique> technique;
  std::unique_ptr<Renderer> renderer;
  gpu::StageTimers timers;
  std::vector<double> frame_ms;
  std::vector<double> started_ms;  ///< when each began, since the subjects were there
  std::string failed;              ///< one sentence; empty: it works
  bool inapplicable = false;       ///< `failed` says why there is nothing to measure, and nothing is wrong

  bool works() const { return failed.empty(); }
};

class Subjects {
 public:
  /// Loads the scene and prepares every configuration. One that the driver or the memory refuses is there with the
  /// reason. Throws izb::Error where the scene cannot be loaded or there is no context.
  explicit Subjects(const Job& job);

  Session& session() { return session_; }
  std::list<Subject>& all() { return subjects_; }
  RenderedFrame rendered(Subject& s);

  /// Every configuration once: a frame of the scene as it stands, timed from finish to finish. Not `measured`: the
  /// times are thrown away. A configuration that fails is out from then on.
  void round(bool measured);
  /// The scene, the camera and the lights to another moment.
  void move_to(double time_s);
  /// Camera and lights that are not the scene's own, for all.
  void look(const Camera& camera, const std::vector<Light>& lights);

  /// Of each configuration: `name`, `technique`, `preset`, `options` (all), `size`, `notes`, `stages` with samples,
  /// `frame_ms`, `frame_samples`, `frame_started_ms` (all where frames were timed), and with `counted` what
  /// add_statistics() and memory_json() say, and `mask_hash`; or `failed`, and `inapplicable` if it is.
  nlohmann::json results(bool counted);

 private:
  void render(Subject& s, bool measured);

  Session session_;
  std::list<Subject> subjects_;
  size_t rounds_ = 0;
  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace izb::bench
