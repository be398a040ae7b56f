// SPDX-License-Identifier: MIT
#include "base/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>

namespace izb {

namespace {

/// Work that advances draws by itself, at most every `shortest`; the thread draws when that has not happened for
/// `longest`.
constexpr std::chrono::milliseconds shortest(100), longest(500);
constexpr size_t bar_cells = 20;

}  // namespace

Progress::Progress(std::string what, uint64_t total, std::FILE* stream)
    : what_(std::move(what)), total_(total), stream_(stream), terminal_(isatty(fileno(stream)) == 1) {
  if (terminal_) drawer_ = std::thread(&Progress::draw_until_done, this);
}

Progress::~Progress() {
  if (!terminal_) return;
  {
    const std::lock_guard lock(drawing_);
    done_drawing_ = true;
  }
  end_.notify_one();
  drawer_.join();
  if (!drawn_) return;
  std::fputs("\r\x1b[K", stream_);
  std::fflush(stream_);
}

void Progress::draw_until_done() {
  std::unique_lock lock(drawing_);
  Clock::time_point wake = next_draw_;
  while (!end_.wait_until(lock, wake, [&] { return done_drawing_; })) {
    const Clock::time_point now = Clock::now();
    const Clock::time_point due = drawn_ ? next_draw_ - shortest + longest : next_draw_;
    if (now >= due) draw(now);
    wake = next_draw_ - shortest + longest;
  }
}

void Progress::draw(Clock::time_point now) {
  next_draw_ = now + shortest;
  drawn_ = true;
  const double seconds = std::chrono::duration<double>(now - start_).count();
  const double share = total_ == 0 ? 0.0 : std::min(double(done_) / double(total_), 1.0);
  const auto full = static_cast<size_t>(share * bar_cells);
  const std::string amount = total_ == 0 ? fmt::format("{:.0f} s", seconds)
                                         : fmt::format("[{}{}] {:.0f} %", std::string(full, '#'),
                                                       std::string(bar_cells - full, '-'), 100.0 * share);
  std::fputs(fmt::format("\r{}: {}\x1b[K", what_, amount).c_str(), stream_);
  std::fflush(stream_);
}

void Progress::advance(uint64_t amount) {
  done_.fetch_add(amount);
  if (!terminal_ || total_ == 0) return;
  const Clock::time_point now = Clock::now();
  // Whoever finds another thread drawing goes on with its work.
  const std::unique_lock lock(drawing_, std::try_to_lock);
  if (!lock || now < next_draw_) return;
  draw(now);
}

void Progress::relabel(std::string what) {
  const std::lock_guard lock(drawing_);
  what_ = std::move(what);
}

}  // namespace izb
