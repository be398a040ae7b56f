// SPDX-License-Identifier: MIT
#include "view/shader_watch.h"

namespace izb {
namespace fs = std::filesystem;

bool ShaderWatch::changed() {
  Times now = read();
  if (now == seen_) return false;
  seen_ = std::move(now);
  return true;
}

ShaderWatch::Times ShaderWatch::read() const {
  Times times;
  std::error_code error;
  for (auto entry = fs::recursive_directory_iterator(folder_, error);
       !error && entry != fs::recursive_directory_iterator(); entry.increment(error)) {
    const std::string extension = entry->path().extension();
    if (extension != ".glsl" && extension != ".h") continue;  // not what an editor keeps beside them
    std::error_code gone;
    const auto time = entry->last_write_time(gone);
    if (!gone) times[entry->path()] = time;
  }
  return times;
}

}  // namespace izb
