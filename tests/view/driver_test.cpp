// SPDX-License-Identifier: MIT
// The tests' own hands and eyes, on a window that reports what reaches it: what these miss, no test of the viewer sees.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include "cpu/gltf_writer.h"
#include "view/captures.h"
#include "view/viewer.h"
#include "view/xdnd_source.h"

namespace {

namespace fs = std::filesystem;
using namespace izb::test;

constexpr int released = 0, pressed = 1;
constexpr int shift = 1, control = 2;
const std::string copied = "izb render 'a b.glb' \u00e4\u20ac";

struct Driver : testing::Test {
  const TemporaryFolder folder;
  XDisplay display;
  Viewer window{display, {{IZB_ECHO_WINDOW, "--copy", copied}, folder / "home", {}}};

  void expect_key(const char* name, int action, int mods) {
    window.wait_for("key",
                    [&](const json& k) { return k["key"] == name && k["action"] == action && k["mods"] == mods; });
  }
  void expect_button(int button, int action, int mods, Point at) {
    window.wait_for("button", [&](const json& b) {
      return b["button"] == button && b["action"] == action && b["mods"] == mods && b["x"] == at.x && b["y"] == at.y;
    });
  }
  /// What a call throws, or "".
  template <typename Call>
  static std::string thrown(Call&& call) {
    try {
      call();
    } catch (const std::runtime_error& e) {
      return e.what();
    }
    return {};
  }
};

TEST_F(Driver, KeysArrive) {
  window.input().key("v");
  expect_key("v", pressed, 0);
  expect_key("v", released, 0);
  window.input().key("ctrl+shift+o");
  expect_key("o", pressed, control | shift);
  for (const char* key : {"1", "Home", "Tab", "Escape", "F1", "F5", "space", "comma", "period"}) {
    window.input().key(key);
    window.wait_for("key", [](const json& k) { return k["action"] == released; });
    EXPECT_EQ(window.since_input("key").size(), 2u) << key;
  }
  window.input().key_down("l");
  expect_key("l", pressed, 0);
  EXPECT_TRUE(window.since_input("key").size() == 1 || window.since_input("key")[1]["action"] != released);
  window.input().key_up("l");
  expect_key("l", released, 0);
  EXPECT_NE(thrown([&] { display.key("nonsense"); }).find("nonsense"), std::string::npos);
}

TEST_F(Driver, TextArrives) {
  const std::string text = "Az_1 -/.,(~";
  window.input().type(text);
  window.wait_for("char", [](const json& c) { return c["code"] == '~'; });
  std::string got;
  for (const json& c : window.since_input("char")) got += char(c["code"].get<int>());
  EXPECT_EQ(got, text);
}

TEST_F(Driver, TheMouseArrives) {
  window.input().drag({40, 50}, {140, 90}, Button::right, 5);
  expect_button(1, pressed, 0, {40, 50});
  expect_button(1, released, 0, {140, 90});
  EXPECT_GE(window.since_input("move").size(), 5u);
  window.input().click({7, 9}, Button::middle);
  expect_button(2, released, 0, {7, 9});
  window.input().key_down("shift");
  display.click({20, 30});
  display.key_up("shift");
  expect_button(0, pressed, shift, {20, 30});
  window.input().double_click({60, 70});
  window.wait_for("button", [n = 0](const json& b) mutable { return b["action"] == released && ++n == 2; });
  EXPECT_EQ(window.since_input("button").size(), 4u);
  window.input().scroll(2);
  window.wait_for("scroll", [n = 0](const json& s) mutable { return s["y"] == 1.0 && ++n == 2; });
  window.input().scroll(-1);
  window.wait_for("scroll", [](const json& s) { return s["y"] == -1.0; });
}

TEST_F(Driver, SizeFocusAndMinimisingArrive) {
  window.input().resize_window(320, 240);
  window.wait_for("size", [](const json& s) { return s["window"] == json({320, 240}); });
  EXPECT_EQ(display.size(), (Point{320, 240}));
  window.input().take_focus();
  window.wait_for("focus", [](const json& f) { return f["focused"] == 0; });
  window.input().focus();
  window.wait_for("focus", [](const json& f) { return f["focused"] == 1; });
  window.input().unmap();
  window.wait_for("iconify", [](const json& i) { return i["minimised"] == 1; });
  window.input().map();
  window.wait_for("iconify", [](const json& i) { return i["minimised"] == 0; });
  window.input().key("v");
  expect_key("v", pressed, 0);
}

TEST_F(Driver, AHeldKeyEndsWithTheFocus) {
  window.input().key_down("w");
  expect_key("w", pressed, 0);
  window.input().take_focus();
  expect_key("w", released, 0);
  display.key_up("w");
}

TEST_F(Driver, FilesDropUnderTheirNames) {
  const auto first = write_file(folder / "a b%20c.glb", "1"),
             second = write_file(folder / "Gr\u00fc\u00dfe #1 \u732b.gltf", "2");
  EXPECT_TRUE(drop_files(window.input(), {first, second}, {150, 100}));
  const json drop = window.wait_for("drop");
  EXPECT_EQ(drop["paths"], json({first, second}));
  EXPECT_EQ(uri_list({"/a \u00e4"}), "file:///a%20%C3%A4\r\n");
}

TEST_F(Driver, TheClipboardIsRead) {
  EXPECT_EQ(display.clipboard(), "");
  window.input().key("ctrl+c");
  expect_key("c", released, control);
  EXPECT_EQ(display.clipboard(), copied);
}

TEST_F(Driver, TheWindowIsSeenAsItIs) {
  const izb::Image8 picture = window.still_capture();
  ASSERT_EQ(picture.width_px, 300);
  ASSERT_EQ(picture.height_px, 200);
  const auto at = [&](int x, int y) {
    const uint8_t* p = &picture.pixels[size_t(y * picture.width_px + x) * 3];
    return std::array<int, 3>{p[0], p[1], p[2]};
  };
  EXPECT_EQ(at(75, 50), (std::array{255, 0, 0}));
  EXPECT_EQ(at(225, 50), (std::array{255, 0, 0}));
  EXPECT_EQ(at(75, 150), (std::array{0, 255, 0}));
  EXPECT_EQ(at(225, 150), (std::array{0, 0, 255}));
}

TEST_F(Driver, TheReportIsFollowed) {
  EXPECT_EQ(window.widget("a button"), (Point{30, 30}));
  EXPECT_FALSE(window.has_widget("another"));
  EXPECT_NE(thrown([&] { window.widget("another"); }).find("another"), std::string::npos);
  EXPECT_EQ(window.state()["number"], 7);
  // Lines before the input do not count.
  window.input();
  EXPECT_NE(thrown([&] { window.wait_for("opened", {}, 0.2); }).find("no 'opened'"), std::string::npos);
  EXPECT_EQ(window.all("opened").size(), 1u);
  EXPECT_NE(thrown([&] { window.wait_at_rest(0.3); }).find("rest"), std::string::npos);
  window.input().key("v");
  EXPECT_EQ(window.wait_at_rest()["serial"], 2);
  EXPECT_EQ(window.since_input("picture").size(), 2u);
}

TEST_F(Driver, StoppingWantsAGoodEnd) {
  window.stop();
  EXPECT_FALSE(window.runs());
  Viewer quits(display, {{IZB_ECHO_WINDOW}, folder / "home", {}});
  quits.input().key("s");
  quits.wait_at_rest();
  quits.input().key("q");
  const std::string said = thrown([&] { quits.stop(); });
  EXPECT_NE(said.find("closed"), std::string::npos) << said;
  EXPECT_NE(said.find("echo_window: a sentence"), std::string::npos) << said;
  Viewer crashes(display, {{IZB_ECHO_WINDOW}, folder / "home", {}});
  crashes.input().key("a");
  const std::string cry = thrown([&] { crashes.wait_for("nothing"); });
  EXPECT_NE(cry.find("the program ended with 134"), std::string::npos) << cry;
  EXPECT_NE(thrown([&] {
              Viewer none(display, {{"/nonexistent"}, folder / "home", {}});
            }).find("127"),
            std::string::npos);
}

TEST(Captures, TheMagnificationIsFound) {
  izb::Image8 original{200, 150, 3, {}};
  uint32_t seed = 1;
  for (int i = 0; i < 200 * 150 * 3; ++i)
    original.pixels.push_back(uint8_t((seed = seed * 1664525u + 1013904223u) >> 24));
  const Point centre{100, 75};
  for (const int m : {1, 2, 8, 32}) {
    izb::Image8 shown = original;
    for (int y = -40; y < 40; ++y)
      for (int x = -40; x < 40; ++x) {
        const auto source = [&](int d) { return int(std::floor(double(d + m / 2) / m)); };
        const uint8_t* from = pixel(original, {centre.x + source(x), centre.y + source(y)});
        std::copy(from, from + 3, &shown.pixels[size_t((centre.y + y) * 200 + centre.x + x) * 3]);
      }
    EXPECT_EQ(magnification(original, shown, centre), m);
    EXPECT_EQ(changed(original, shown, {0, 0, 200, 35}), 0u);
    EXPECT_EQ(changed(original, shown, {60, 35, 140, 115}) > 0, m > 1);
    EXPECT_FALSE(is_flat(shown, middle_of(shown)));
  }
  EXPECT_TRUE(is_flat({200, 150, 3, std::vector<uint8_t>(200 * 150 * 3, 7)}, {10, 10, 90, 90}));
}

/// What a killed test leaves behind must go by itself.
TEST(DriverEnd, NothingOutlivesTheTest) {
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  const pid_t test = fork();
  ASSERT_GE(test, 0);
  if (test == 0) {
    XDisplay display;
    const pid_t server = display.server();
    if (write(ends[1], &server, sizeof server) == sizeof server) pause();
    _exit(1);
  }
  pid_t server = 0;
  ASSERT_EQ(read(ends[0], &server, sizeof server), ssize_t(sizeof server));
  EXPECT_EQ(kill(server, 0), 0);
  kill(test, SIGKILL);
  waitpid(test, nullptr, 0);
  // An orphan that init has not yet reaped still has its number.
  EXPECT_TRUE(wait_until(10.0, [&] {
    std::ifstream status("/proc/" + std::to_string(server) + "/stat");
    std::string number, name, state;
    return !(status >> number >> name >> state) || state == "Z";
  }));
  close(ends[0]);
  close(ends[1]);
}

}  // namespace
