// SPDX-License-Identifier: MIT
// A parallel loop over chunks: threads take the next chunk from one counter, so uneven work balances itself.
#pragma once
#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace izb::reference {

/// `requested`, or all cores where it is 0.
inline unsigned thread_count(unsigned requested) {
  return requested ? requested : std::max(1u, std::thread::hardware_concurrency());
}

/// Calls body(begin, end, thread) for consecutive chunks of [0, count) on `threads` threads (0: all cores).
/// The calling thread is thread 0. Rethrows the first exception of any chunk after all threads have ended.
template <typename Body>
void parallel_for(size_t count, size_t chunk, unsigned threads, Body&& body) {
  std::atomic<size_t> next{0};
  std::exception_ptr error;
  std::mutex error_guard;
  const auto work = [&](unsigned thread) {
    try {
      for (size_t begin; (begin = next.fetch_add(chunk)) < count;) body(begin, std::min(begin + chunk, count), thread);
    } catch (...) {
      next = count;
      const std::scoped_lock lock(error_guard);
      if (!error) error = std::current_exception();
    }
  };
  const size_t chunks = (count + chunk - 1) / chunk;
  const unsigned used = static_cast<unsigned>(std::min<size_t>(thread_count(threads), chunks));
  {
    std::vector<std::jthread> others;
    for (unsigned i = 1; i < used; ++i) others.emplace_back(work, i);
    if (used) work(0);
  }
  if (error) std::rethrow_exception(error);
}

}  // namespace izb::reference
