// SPDX-License-Identifier: MIT
#include "view/viewer.h"

#include <algorithm>
#include <stdexcept>

namespace izb::test {
namespace {

namespace fs = std::filesystem;

/// A name that no program before has written to.
fs::path new_report(const fs::path& home) {
  fs::create_directories(home);
  for (int n = 1;; ++n)
    if (fs::path path = home / ("report" + std::to_string(n) + ".jsonl"); !fs::exists(path)) return path;
}

std::vector<std::string> with_report(std::vector<std::string> words, const fs::path& report) {
  words.insert(words.end(), {"--report", report});
  return words;
}

Environment environment_of(const XDisplay& display, const ViewerOptions& options) {
  // Mesa's cache of compiled shaders is not the program's: it stays where it is.
  const auto value = [](const char* name) { return std::string(std::getenv(name) ? std::getenv(name) : ""); };
  const std::string cache = value("XDG_CACHE_HOME");
  Environment all{{"DISPLAY", display.name()},
                  {"HOME", options.home},
                  {"XDG_CONFIG_HOME", options.home / ".config"},
                  {"XDG_CACHE_HOME", cache.empty() ? value("HOME") + "/.cache" : cache},
                  {"LIBGL_ALWAYS_SOFTWARE", "1"},
                  {"IZB_GL_DEBUG", "1"}};
  for (const auto& [name, text] : options.environment) all[name] = text;
  return all;
}

bool is_at_rest(const nlohmann::json& picture) {
  return picture["scale"].get<double>() == 1.0 && !picture["motion"].get<bool>();
}

}  // namespace

Viewer::Viewer(XDisplay& display, const ViewerOptions& options)
    : display_(display),
      report_(new_report(options.home)),
      child_(with_report(options.words, report_), environment_of(display, options)) {
  wait_for("opened");
  XDisplay::Window window = 0;
  if (!wait_until(30.0, [&] { return (window = display_.find_window(child_.pid())) != 0; })) fail("it has no window");
  display_.use(window);
}

XDisplay& Viewer::input() {
  read();
  first_ = lines_.size();
  return display_;
}

void Viewer::read() {
  if (!stream_.is_open()) stream_.open(report_, std::ios::binary);
  if (!stream_.is_open()) return;
  stream_.clear();  // of the last end of file
  char bytes[65536];
  while (stream_.read(bytes, sizeof bytes), stream_.gcount() > 0) rest_.append(bytes, size_t(stream_.gcount()));
  for (size_t end; (end = rest_.find('\n')) != std::string::npos; rest_.erase(0, end + 1)) {
    lines_.push_back(json::parse(rest_.begin(), rest_.begin() + std::ptrdiff_t(end)));
  }
}

void Viewer::fail(const std::string& what) {
  read();
  std::string text = what + "; the report's last lines:\n";
  constexpr size_t shown_lines = 15, shown_length = 400;
  const size_t shown_from = std::max(first_, lines_.size() - std::min(lines_.size(), shown_lines));
  for (size_t i = shown_from; i < lines_.size(); ++i) {
    const std::string line = lines_[i].dump();
    text += "  " + line.substr(0, shown_length) + (line.size() > shown_length ? "...\n" : "\n");
  }
  text += runs() ? "the program still runs" : "the program ended with " + std::to_string(child_.code());
  throw std::runtime_error(text + "; it said:\n" + child_.err());
}

Viewer::json Viewer::wait_for(const std::string& event, const Predicate& predicate, double timeout_s) {
  size_t next = first_;
  const json* found = nullptr;
  const auto look = [&] {
    read();
    for (; next < lines_.size(); ++next)
      if (lines_[next]["event"] == event && (!predicate || predicate(lines_[next]))) {
        found = &lines_[next];
        return true;
      }
    return false;
  };
  wait_until(timeout_s, [&] { return look() || !runs(); });
  if (!found && !look()) fail("no '" + event + "' as it should be came");
  return *found;
}

Viewer::json Viewer::wait_at_rest(double timeout_s) {
  // A line of rest counts after an answer, and if no other follows: before it may be that of the input before, or of
  // the first part of a drag.
  constexpr double quiet_s = 0.3;
  double since_s = now_s();
  size_t seen = 0;
  const bool rests = wait_until(timeout_s, [&] {
    if (!runs()) return true;
    read();
    bool answered = first_ == 0, rested = false;  // nothing was put in yet
    size_t answers = 0;
    for (size_t i = first_; i < lines_.size(); ++i) {
      if (lines_[i]["event"] == "answer") answered = true, rested = false, ++answers;
      if (lines_[i]["event"] == "rest") rested = answered;
    }
    if (answers != seen || !rested) since_s = now_s();
    seen = answers;
    return rested && now_s() - since_s > quiet_s;
  });
  json picture = last("picture");
  if (!rests || picture.is_null() || !is_at_rest(picture)) fail("the picture does not come to rest");
  return picture;
}

Image8 Viewer::still_capture() {
  Image8 before = display_.capture();
  for (int i = 0; i < 60; ++i) {
    sleep_s(0.25);
    Image8 now = display_.capture();
    if (now.pixels == before.pixels) return now;
    before = std::move(now);
  }
  fail("the window does not stop changing");
}

std::vector<Viewer::json> Viewer::since_input(const std::string& event) {
  read();
  std::vector<json> found;
  std::copy_if(lines_.begin() + std::ptrdiff_t(first_), lines_.end(), std::back_inserter(found),
               [&](const json& line) { return line["event"] == event; });
  return found;
}

std::vector<Viewer::json> Viewer::all(const std::string& event) {
  read();
  std::vector<json> found;
  std::copy_if(lines_.begin(), lines_.end(), std::back_inserter(found),
               [&](const json& line) { return line["event"] == event; });
  return found;
}

Viewer::json Viewer::last(const std::string& event) {
  read();
  const auto line = std::find_if(lines_.rbegin(), lines_.rend(), [&](const json& l) { return l["event"] == event; });
  return line == lines_.rend() ? json() : *line;
}

Viewer::json Viewer::state() {
  const json line = last("state");
  if (line.is_null()) fail("it has not said its state");
  return line["state"];
}

bool Viewer::has_widget(const std::string& label) {
  const json line = last("widgets");
  return !line.is_null() && line["rects"].contains(label);
}

Point Viewer::widget(const std::string& label) {
  if (!has_widget(label)) fail("there is no widget '" + label + "'");
  const auto rect = last("widgets")["rects"][label].get<std::array<double, 4>>();
  return {int((rect[0] + rect[2]) / 2), int((rect[1] + rect[3]) / 2)};
}

void Viewer::stop() {
  display_.close();
  if (!child_.wait(60.0)) fail("it does not end when its window is closed");
  if (child_.code() != 0) fail("it does not end well");
  read();
  if (lines_.empty() || lines_.back()["event"] != "closed") fail("'closed' is not the last line");
}

}  // namespace izb::test
