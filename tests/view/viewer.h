// SPDX-License-Identifier: MIT
// The interactive program under test: a process with a window on the test's display, and the report that it writes.
#pragma once
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>

#include "view/x_display.h"

namespace izb::test {

struct ViewerOptions {
  std::vector<std::string> words;  ///< the program and its arguments; --report is added
  std::filesystem::path home;      ///< of the person: $HOME, with .config as $XDG_CONFIG_HOME
  Environment environment;
};

/// What fails throws std::runtime_error with what the report and the program said last.
class Viewer {
 public:
  using json = nlohmann::json;
  using Predicate = std::function<bool(const json&)>;

  /// Waits for the window and for `opened`.
  Viewer(XDisplay& display, const ViewerOptions& options);

  /// For what a person does next: wait_for() looks only at lines that come from now on.
  XDisplay& input();

  /// The first line of that event since input() for which the predicate holds.
  json wait_for(const std::string& event, const Predicate& predicate = {}, double timeout_s = 60.0);

  /// The picture at full resolution that shows the outcome of the input.
  json wait_at_rest(double timeout_s = 120.0);

  /// What the window shows when it no longer changes.
  Image8 still_capture();

  /// The last line of that event, or null.
  json last(const std::string& event);
  /// Its `state`.
  json state();
  /// All lines of that event since input().
  std::vector<json> since_input(const std::string& event);
  std::vector<json> all(const std::string& event);

  bool has_widget(const std::string& label);
  Point widget(const std::string& label);  ///< its centre

  bool runs() { return child_.runs(); }
  std::string err() const { return child_.err(); }

  /// Closes the window as a person does; the program must say `closed` and end with 0.
  void stop();

 private:
  void read();
  [[noreturn]] void fail(const std::string& what);

  XDisplay& display_;
  const std::filesystem::path report_;
  Child child_;
  std::ifstream stream_;
  std::string rest_;  ///< of a line that is not complete
  std::vector<json> lines_;
  size_t first_ = 0;  ///< the first line since the input
};

}  // namespace izb::test
