// SPDX-License-Identifier: MIT
// Progress of long work, on a terminal only.
#pragma once
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <cstdio>
#include <mutex>
#include <string>
#include <thread>

namespace izb {

/// Draws "what: [####----] 50 %" on one line that is rewritten in place, from one second after the start on, and clears
/// it when destroyed. Where the amount of work is unknown, or one step of it takes long, a thread keeps it up to date.
/// Draws nothing if the stream is no terminal.
class Progress {
 public:
  /// `total` is the amount of work in any unit, that of advance(); 0: unknown, and seconds are shown. The stream is
  /// stderr but for tests.
  Progress(std::string what, uint64_t total, std::FILE* stream = stderr);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Adds `amount` to the work done. Any thread may call it.
  void advance(uint64_t amount = 1);

  /// Another name for what is going on, for the next phase of the work.
  void relabel(std::string what);

 private:
  using Clock = std::chrono::steady_clock;

  void draw(Clock::time_point now);  ///< `drawing_` is held
  void draw_until_done();

  std::string what_;  ///< guarded by `drawing_`
  const uint64_t total_;
  std::FILE* const stream_;
  const bool terminal_;
  const Clock::time_point start_ = Clock::now();
  std::atomic<uint64_t> done_{0};
  std::mutex drawing_;
  Clock::time_point next_draw_ = start_ + std::chrono::seconds(1);  ///< guarded by `drawing_`
  bool drawn_ = false;                                              ///< guarded by `drawing_`
  bool done_drawing_ = false;                                       ///< guarded by `drawing_`
  std::condition_variable end_;
  std::thread drawer_;  ///< on a terminal only
};

}  // namespace izb
