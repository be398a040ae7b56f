// SPDX-License-Identifier: MIT
// A process that ends with the test, whatever becomes of the test.
#pragma once
#include <sys/types.h>

#include <cstdio>
#include <map>
#include <string>
#include <vector>

namespace izb::test {

using Environment = std::map<std::string, std::string>;

class Child {
 public:
  /// words[0] is looked up in PATH. `added` goes on top of this process's environment. Throws std::runtime_error.
  explicit Child(const std::vector<std::string>& words, const Environment& added = {});
  ~Child();  ///< kills it
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  pid_t pid() const { return pid_; }
  bool runs();
  void end();   ///< as a request, by SIGTERM
  void kill();  ///< at once

  /// Waits until it ends. Returns false if it still runs after that time.
  bool wait(double timeout_s);

  /// The exit code; 128 + the signal's number if one ended it; -1 while it runs.
  int code() const { return code_; }

  /// What it has written up to now.
  std::string out() const { return text_of(out_); }
  std::string err() const { return text_of(err_); }

 private:
  static std::string text_of(std::FILE* file);

  pid_t pid_ = -1;
  int code_ = -1;
  std::FILE *out_, *err_;
};

double now_s();  ///< of a clock that never goes back
void sleep_s(double seconds);

/// Asks again and again until it is so. Returns false if it is not after that time.
template <typename Condition>
bool wait_until(double timeout_s, Condition&& condition) {
  for (const double end_s = now_s() + timeout_s; now_s() < end_s; sleep_s(0.005))
    if (condition()) return true;
  return condition();
}

}  // namespace izb::test
