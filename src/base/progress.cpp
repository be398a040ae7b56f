// SPDX-License-Identifier: MIT
#include "base/progress.h"

#include <fmt/format.h>
#include <unistd.h>

namespace izb {

Progress::Progress(std::string what, uint64_t total, std::FILE* stream)
    : what_(std::move(what)), total_(total), stream_(stream), terminal_(isatty(fileno(stream)) == 1) {}

Progress::~Progress() {
  if (!drawn_) return;
  std::fputs("\r\x1b[K", stream_);
  std::fflush(stream_);
}

void Progress::advance(uint64_t amount) {
  const uint64_t done = done_.fetch_add(amount) + amount;
  if (!terminal_ || total_ == 0) return;
  const Clock::time_point now = Clock::now();
  // Whoever finds another thread drawing goes on with its work.
  const std::unique_lock lock(drawing_, std::try_to_lock);
  if (!lock || now < next_draw_) return;
  next_draw_ = now + std::chrono::milliseconds(100);
  drawn_ = true;
  const double percent = 100.0 * double(done) / double(total_);
  std::fputs(fmt::format("\r{}: {:.0f} %\x1b[K", what_, percent).c_str(), stream_);
  std::fflush(stream_);
}

}  // namespace izb
