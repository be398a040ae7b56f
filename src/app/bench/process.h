// SPDX-License-Identifier: MIT
// A child process with a time limit, so that what it does to itself stays its own.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace izb::bench {

/// How a child ended: by itself with `exit_code`, by a signal, or because its time was up, or this process was asked to
/// end.
struct ChildEnd {
  int exit_code = 0;
  int signal = 0;
  bool timed_out = false, interrupted = false;

  bool well() const { return exit_code == 0 && signal == 0 && !timed_out && !interrupted; }
};

/// From now on SIGINT, SIGTERM and SIGHUP do not end this process: interrupted() says so, and run_child() ends its
/// child. Those that are ignored stay so, as for nohup.
void catch_interrupts();
bool interrupted();

/// Runs this program with `arguments`; what it prints goes to the file `log`. It ends with this process, whatever ends
/// that. Throws izb::Error where it cannot be started or the log cannot be written.
ChildEnd run_child(const std::vector<std::string>& arguments, const std::filesystem::path& log, double time_limit_s);

/// While it lives, no other process has one of the same folder. Throws izb::Error where another has.
class FolderLock {
 public:
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

  /// Not where the file system knows no locks: there nothing is known of others.
  bool held() const { return held_; }

 private:
  int folder_ = -1;
  bool held_ = false;
};

}  // namespace izb::bench
