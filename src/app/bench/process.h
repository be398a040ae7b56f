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

/// From now on SIGINT and SIGTERM do not end this process: interrupted() says so, and run_child() ends its child.
void catch_interrupts();
bool interrupted();

/// Runs this program with `arguments`; what it prints goes to the file `log`. It ends with this process, whatever ends
/// that. Throws izb::Error where it cannot be started or the log cannot be written.
ChildEnd run_child(const std::vector<std::string>& arguments, const std::filesystem::path& log, double time_limit_s);

}  // namespace izb::bench
