// SPDX-License-Identifier: MIT
// The ray-traced mask of a frame, in the background: a few rows at a time, so that it can be given up.
#pragma once
#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "reference/truth.h"

namespace izb {

/// What is traced: everything about the frame that a ray asks for.
struct TruthTask {
  uint64_t serial = 0;  ///< of the frame
  reference::Triangles triangles;
  std::vector<reference::LightPoint> lights;
  std::vector<reference::Receivers> receivers;  ///< one set a light, top row first
};

struct TracedTruth {
  uint64_t serial = 0;
  std::vector<std::vector<uint32_t>> masks;  ///< one a light, top row first
  std::string error;                         ///< why there are none, or empty
};

/// One job at a time; starting another gives up the one before. Its own thread does the work.
class TruthJob {
 public:
  /// `done` is called from that thread.
  explicit TruthJob(std::function<void(TracedTruth)> done) : done_(std::move(done)) {}
  ~TruthJob() { cancel(); }

  void start(TruthTask task);
  void cancel();
  /// From 0 to 1.
  float progress() const { return progress_; }

 private:
  void work(const TruthTask& task);

  std::function<void(TracedTruth)> done_;
  std::thread thread_;
  std::atomic<bool> cancelled_ = false;
  std::atomic<float> progress_ = 0.0f;
};

}  // namespace izb
