// SPDX-License-Identifier: MIT
// Progress of long work, on a terminal only.
#pragma once
#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <mutex>
#include <string>

namespace izb {

/// Draws "what: 42 %" on one line that is rewritten in place, from one second after the start on, and clears
/// it when destroyed. Draws nothing if the stream is no terminal.
class Progress {
 public:
  /// `total` is the amount of work in any unit, that of advance(). The stream is stderr but for tests.
  Progress(std::string what, uint64_t total, std::FILE* stream = stderr);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Adds `amount` to the work done. Any thread may call it.
  void advance(uint64_t amount = 1);

 private:
  using Clock = std::chrono::steady_clock;

  const std::string what_;
  const uint64_t total_;
  std::FILE* const stream_;
  const bool terminal_;
  const Clock::time_point start_ = Clock::now();
  std::atomic<uint64_t> done_{0};
  std::mutex drawing_;
  Clock::time_point next_draw_ = start_ + std::chrono::seconds(1);  ///< guarded by `drawing_`
  bool drawn_ = false;                                              ///< guarded by `drawing_`
};

}  // namespace izb
