// SPDX-License-Identifier: MIT
#include "base/machine_memory.h"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <string>
#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace izb {
namespace {

namespace fs = std::filesystem;

/// The number that stands alone in a file; nothing for "max" or a file that is not there.
std::optional<uint64_t> number_in(const fs::path& path) {
  uint64_t value = 0;
  std::ifstream in(path);
  return in >> value ? std::optional(value) : std::nullopt;
}

/// The number after a word at the beginning of a line.
std::optional<uint64_t> number_after(const fs::path& path, const std::string& word) {
  std::ifstream in(path);
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string first;
    uint64_t value = 0;
    if (words >> first >> value && first == word) return value;
  }
  return std::nullopt;
}

/// Cached files count as used in a group, but make room for whoever asks.
uint64_t left(uint64_t limit, uint64_t used, uint64_t cached) {
  const uint64_t held = used - std::min(used, cached);
  return limit - std::min(limit, held);
}

/// Of one group's folder, version 2 or 1.
std::optional<uint64_t> left_in_group(const fs::path& folder) {
  const auto of = [&](const char* limit, const char* used, const std::string& prefix) -> std::optional<uint64_t> {
    const auto most = number_in(folder / limit), now = number_in(folder / used);
    if (!most || !now) return std::nullopt;
    const fs::path stat = folder / "memory.stat";
    return left(*most, *now,
                number_after(stat, prefix + "inactive_file").value_or(0) +
                    number_after(stat, prefix + "active_file").value_or(0));
  };
  const auto second = of("memory.max", "memory.current", "");
  return second ? second : of("memory.limit_in_bytes", "memory.usage_in_bytes", "total_");
}

}  // namespace

std::optional<uint64_t> available_main_memory(const fs::path& root) {
  std::optional<uint64_t> least;
  const auto take = [&](std::optional<uint64_t> bytes) {
    if (bytes) least = std::min(least.value_or(*bytes), *bytes);
  };
  if (const auto kilobytes = number_after(root / "proc/meminfo", "MemAvailable:")) take(*kilobytes * 1024);
  // Lines "0::/a/b" (version 2) and "4:memory:/a/b" (version 1). A container may see its own group as the root.
  std::ifstream in(root / "proc/self/cgroup");
  for (std::string line; std::getline(in, line);) {
    const size_t first = line.find(':'), second = line.find(':', first + 1);
    if (first == std::string::npos || second == std::string::npos) continue;
    const std::string controllers = line.substr(first + 1, second - first - 1);
    if (!controllers.empty() && controllers != "memory") continue;
    const fs::path mount = root / (controllers.empty() ? "sys/fs/cgroup" : "sys/fs/cgroup/memory");
    fs::path group = fs::path(line.substr(second + 1)).relative_path();
    for (; !group.empty(); group = group.parent_path()) take(left_in_group(mount / group));
    take(left_in_group(mount));
  }
  return least;
}

std::optional<uint64_t> process_memory() {
  const auto kilobytes = number_after("/proc/self/status", "VmRSS:");
  return kilobytes ? std::optional(*kilobytes * 1024) : std::nullopt;
}

std::optional<uint64_t> peak_process_memory() {
  const auto kilobytes = number_after("/proc/self/status", "VmHWM:");
  return kilobytes ? std::optional(*kilobytes * 1024) : std::nullopt;
}

void give_back_freed_memory() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

}  // namespace izb
