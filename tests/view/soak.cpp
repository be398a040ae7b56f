// SPDX-License-Identifier: MIT
// view_soak SECONDS SEED: a person who does anything, as long as it takes. Fails if the viewer ends, stops answering,
// reports a GL error, or grows.
#include <algorithm>
#include <cstdio>
#include <deque>
#include <memory>
#include <random>
#include <stdexcept>

#include "view/contract.h"
#include "view/viewer.h"
#include "view/viewer_scenes.h"
#include "view/xdnd_source.h"

namespace {

namespace fs = std::filesystem;
using namespace izb::test;

constexpr const char* keys[] = {"Home", "n",      "k",       "1",  "p",  "t",     "c",     "x",
                                "r",    "v",      "shift+v", "g",  "z",  "space", "comma", "period",
                                "F1",   "Escape", "Tab",     "F2", "F3", "F4",    "F5",    "ctrl+c"};
constexpr Point first_size{480, 300}, largest_size{700, 450};

class Soak {
 public:
  Soak(double seconds, unsigned seed) : seconds_(seconds), random_(seed) {
    good_ = {write_file(folder_ / "posts.glb", posts_on_floor().glb()),
             write_file(folder_ / "sliding roof \u00e4.glb", sliding_roof().glb())};
    bad_ = {write_file(folder_ / "text.glb", "no scene"), folder_ / "missing.glb", folder_ / "home"};
    fs::create_directories(written_);
    viewer_ = std::make_unique<Viewer>(
        display_,
        ViewerOptions{
            {IZB_PROGRAM, "view", good_[0], "--size", "480x300", "--folder", written_}, folder_ / "home", {}});
    viewer_->wait_at_rest();
    // With both sides on the screen, so that each time the memory is measured both hold what they hold now.
    viewer_->input().key("c");
    viewer_->wait_for("state", [](const json& line) { return compare_of(line["state"]) == "split"; });
    first_sides_ = viewer_->wait_at_rest()["sides"];
    first_state_ = viewer_->state();
    viewer_->input().key("ctrl+s");
    state_file_ = written_ / viewer_->wait_for("wrote")["files"][0].get<std::string>();
    state_ = text_of(state_file_);
  }

  void run() {
    if (seconds_ >= 180.0) tour();
    const double start_s = now_s();
    double baseline_bytes = 0.0;
    for (double measured_s = 0.0, at_s; (at_s = now_s() - start_s) < seconds_;) {
      act();
      check();
      // After the first minute, and then as often as shows where growth begins.
      if (seconds_ < 180.0 || at_s < (baseline_bytes == 0.0 ? 60.0 : measured_s + 300.0)) continue;
      measured_s = at_s;
      const double bytes = bytes_at_home();
      std::printf("memory after %.0f s: %.1f MB\n", at_s, bytes / 1e6);
      std::fflush(stdout);
      if (baseline_bytes == 0.0) baseline_bytes = bytes;
    }
    if (baseline_bytes > 0.0) {
      const double bytes = bytes_at_home();
      std::printf("memory at the end: %.1f MB\n", bytes / 1e6);
      if (bytes > 1.1 * baseline_bytes) throw std::runtime_error("the memory grows");
    }
    go_home();
    check();
    viewer_->stop();
    std::printf("%d inputs\n", count_);
  }

  void print_last_inputs() const {
    for (const std::string& input : last_inputs_) std::fprintf(stderr, "  %s\n", input.c_str());
  }

 private:
  int up_to(int last) { return std::uniform_int_distribution<int>(0, last)(random_); }
  Point somewhere() {
    const Point size = display_.size();
    return {up_to(size.x - 1), up_to(size.y - 1)};
  }

  /// Everything once, in the largest window, so that what is loaded or compiled at its first use is there.
  void tour() {
    doing("the largest window").resize_window(largest_size.x, largest_size.y);
    viewer_->wait_at_rest(300.0);
    for (const char* key : keys)
      for (int times = 0; times < 4; ++times) {
        doing(std::string("tour ") + key).key(key);
        viewer_->wait_at_rest(300.0);
      }
    for (const fs::path& file : good_) {
      drop_files(doing("tour drop"), {file}, {0, 0});
      viewer_->wait_at_rest(300.0);
    }
    go_home();
  }

  /// `what` is about to be done.
  XDisplay& doing(const std::string& what) {
    last_inputs_.push_back(what);
    if (last_inputs_.size() > 40) last_inputs_.pop_front();
    ++count_;
    return viewer_->input();
  }

  void act() {
    const int kind = up_to(99);
    if (kind < 40) {
      const char* key = keys[up_to(int(std::size(keys)) - 1)];
      doing(std::string("key ") + key).key(key);
    } else if (kind < 60) {
      drag();
    } else if (kind < 70) {
      const int clicks = up_to(1) == 0 ? up_to(5) : -up_to(5);
      doing("scroll " + std::to_string(clicks)).scroll(clicks);
    } else if (kind < 88) {
      click();
    } else if (kind < 93) {
      fly();
    } else if (kind < 96) {
      resize();
    } else {
      drop();
    }
    sleep_s(0.02 * up_to(10));
  }

  void drag() {
    static constexpr const char* modifiers[] = {"", "", "", "shift", "l"};
    const Point from = somewhere(), to = somewhere();
    const Button button = Button(1 + up_to(2));
    const std::string held = modifiers[up_to(4)];
    XDisplay& x = doing("drag by button " + std::to_string(int(button)) + " with '" + held + "' " + text(from) +
                        " to " + text(to));
    if (!held.empty()) x.key_down(held);
    x.drag(from, to, button, 1 + up_to(20));
    if (!held.empty()) x.key_up(held);
  }

  void click() {
    const json widgets = viewer_->last("widgets");
    if (up_to(2) == 0 || widgets.is_null() || widgets["rects"].empty()) {
      const Point at = somewhere();
      up_to(3) == 0 ? doing("double click at " + text(at)).double_click(at) : doing("click at " + text(at)).click(at);
      return;
    }
    auto widget = widgets["rects"].begin();
    std::advance(widget, up_to(int(widgets["rects"].size()) - 1));
    if (is_left_alone(widget.key())) return;
    doing("click on '" + widget.key() + "'").click(viewer_->widget(widget.key()));
  }

  void fly() {
    static constexpr const char* ways[] = {"w", "a", "s", "d", "q", "e"};
    const std::string way = ways[up_to(5)];
    const bool loses_focus = up_to(3) == 0;
    XDisplay& x = doing("fly " + way + (loses_focus ? " and lose the focus" : ""));
    x.move(somewhere());
    x.button_down(Button::right);
    x.key_down(way);
    sleep_s(0.3);
    if (loses_focus) x.take_focus();
    x.key_up(way);
    x.button_up(Button::right);
    x.focus();
  }

  void resize() {
    if (up_to(3) == 0) {
      doing("minimise and restore").unmap();
      sleep_s(0.3);
      display_.map();
      return;
    }
    const Point size =
        up_to(5) == 0 ? Point{1, 1} : Point{200 + up_to(largest_size.x - 200), 150 + up_to(largest_size.y - 150)};
    doing("resize to " + text(size)).resize_window(size.x, size.y);
  }

  void drop() {
    const std::vector<fs::path>& from = up_to(1) == 0 ? good_ : bad_;
    const fs::path& file = from[size_t(up_to(int(from.size()) - 1))];
    drop_files(doing("drop " + file.filename().string()), {file}, {0, 0});
  }

  void check() {
    if (!viewer_->runs()) throw std::runtime_error("the viewer has ended:\n" + viewer_->err());
    if (viewer_->err().find("warning: GL:") != std::string::npos)
      throw std::runtime_error("the driver complains:\n" + viewer_->err());
    for (const json& message : viewer_->all("message"))
      if (message["text"].get<std::string>().find("GL error") != std::string::npos)
        throw std::runtime_error(message["text"].get<std::string>());
    // Each screenshot takes megabytes.
    std::vector<fs::path> pictures;
    for (const auto& entry : fs::directory_iterator(written_))
      if (entry.path().extension() == ".exr") pictures.push_back(entry.path());
    for (const fs::path& path : pictures) fs::remove(path);
  }

  /// The state of the beginning, at rest.
  void go_home() {
    XDisplay& x = doing("home");
    x.resize_window(first_size.x, first_size.y);
    for (int i = 0; i < 3; ++i) x.key("Escape");
    write_file(state_file_, state_);
    x.key("ctrl+o");
    if (!wait_until(300.0, [&] { return !viewer_->runs() || viewer_->state() == first_state_; }))
      throw std::runtime_error("the state of the beginning does not come back: " + viewer_->state().dump());
    const json sides = viewer_->wait_at_rest(300.0)["sides"];
    if (sides != first_sides_)
      throw std::runtime_error("the picture of the beginning does not come back: " + sides.dump() + " for " +
                               first_sides_.dump());
  }

  double bytes_at_home() {
    go_home();
    doing("memory");
    double bytes = 0.0;
    viewer_->wait_for("memory", [&, n = 0](const json& line) mutable {
      bytes = line["bytes"];
      return ++n == 2;  // the first may be from before
    });
    return bytes;
  }

  static std::string text(Point p) { return std::to_string(p.x) + "," + std::to_string(p.y); }
  static std::string text_of(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  const double seconds_;
  std::mt19937 random_;
  const TemporaryFolder folder_;
  const fs::path written_ = folder_ / "written";
  std::vector<fs::path> good_, bad_;
  fs::path state_file_;
  std::string state_;
  json first_state_, first_sides_;
  XDisplay display_;
  std::unique_ptr<Viewer> viewer_;
  std::deque<std::string> last_inputs_;
  int count_ = 0;
};

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fputs("usage: view_soak SECONDS SEED\n", stderr);
    return 2;
  }
  std::unique_ptr<Soak> soak;
  try {
    soak = std::make_unique<Soak>(std::stod(argv[1]), unsigned(std::stoul(argv[2])));
    soak->run();
  } catch (const std::exception& e) {
    std::fprintf(stderr, "view_soak: seed %s: %s\nlast inputs:\n", argv[2], e.what());
    if (soak) soak->print_last_inputs();
    return 1;
  }
}
