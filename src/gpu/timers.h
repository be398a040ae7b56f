// SPDX-License-Identifier: MIT
// Stage times: timer queries on a GPU; on a software renderer the wall clock between finishes, since llvmpipe's timer
// queries miss compute passes and all vertex and geometry work.
#pragma once
#include <chrono>
#include <string>
#include <vector>

#include "gpu/objects.h"

namespace izb::gpu {

/// Collects samples in milliseconds, one list a name, in order of first use: one a frame, the sum of the scopes of that
/// name since the last collect().
class StageTimers {
 public:
  explicit StageTimers(bool wall_clock) : wall_clock_(wall_clock) {}

  struct Stage {
    std::string name;
    std::vector<double> samples_ms;
  };

  /// A debug group and a timed section of the frame; ends with the object.
  class Scope {
   public:
    Scope(StageTimers& timers, const char* name);
    ~Scope();
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

   private:
    StageTimers& timers_;
    const char* name_;
    std::chrono::steady_clock::time_point start_;
    Query begin_, end_;
  };

  /// Ends a frame: reads its queries and adds its samples.
  void collect();
  /// Forgets all samples, and what a frame that was given up left uncollected.
  void clear() { stages_.clear(), pending_.clear(); }
  const std::vector<Stage>& stages() const { return stages_; }
  const char* method() const { return wall_clock_ ? "wall" : "query"; }
  bool wall_clock() const { return wall_clock_; }

 private:
  struct Pending {
    std::string name;
    double ms;  ///< of the wall clock
    Query begin, end;
  };

  bool wall_clock_;
  std::vector<Stage> stages_;
  std::vector<Pending> pending_;
};

}  // namespace izb::gpu
