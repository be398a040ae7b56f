// SPDX-License-Identifier: MIT
// What happens in the viewer, as JSON lines for scripts and tests: docs/VIEW.md lists the events.
#pragma once
#include <chrono>
#include <cstdio>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>

namespace izb {

class Report {
 public:
  /// Empty: nothing is written. Throws izb::Error if the file cannot be.
  explicit Report(const std::string& path);
  /// Any thread may write.
  void write(const char* event, nlohmann::json keys = nlohmann::json::object());
  bool on() const { return file_ != nullptr; }

 private:
  struct Closer {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::unique_ptr<std::FILE, Closer> file_;
  std::mutex mutex_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace izb
