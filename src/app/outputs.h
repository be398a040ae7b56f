// SPDX-License-Identifier: MIT
// The files that one run leaves behind.
#pragma once
#include <deque>
#include <filesystem>
#include <map>
#include <string>

#include "base/file.h"

namespace izb {

/// All are opened before the work, so that one which cannot be written is known early, and appear together or not at
/// all.
class Outputs {
 public:
  /// Null where `path` is empty: not asked for. Throws UsageError if an earlier output names the same file (a device
  /// may take several), izb::Error if it cannot be written. `option` is for messages.
  AtomicFile* open(const std::string& option, const std::string& path);

  /// All are on the disk before the first appears, so that a full one leaves none.
  void commit();

  /// As given, in the order of opening.
  const std::deque<AtomicFile>& files() const { return files_; }

 private:
  std::map<std::filesystem::path, std::string> taken_;
  std::deque<AtomicFile> files_;  // they do not move
};

}  // namespace izb
