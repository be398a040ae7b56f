// SPDX-License-Identifier: MIT
// An X server of the test's own, and a person at it: keys and mouse by XTest, pictures of a window, the clipboard.
// No window manager runs there, so that the test does what one would do: focus, size, minimise, close.
#pragma once
#include <filesystem>
#include <string>

#include "image/image.h"
#include "view/child.h"

struct _XDisplay;  // Xlib's Display; its headers define macros such as None and Bool

namespace izb::test {

struct Point {
  int x = 0, y = 0;
  Point operator+(const Point& p) const { return {x + p.x, y + p.y}; }
  bool operator==(const Point&) const = default;
};

enum class Button { left = 1, middle = 2, right = 3 };

/// Points are relative to the window that use() named. What fails throws std::runtime_error.
class XDisplay {
 public:
  using Window = unsigned long;

  XDisplay();  ///< starts Xvfb: 1280 x 800, 24 bits, GLX
  ~XDisplay();
  XDisplay(const XDisplay&) = delete;
  XDisplay& operator=(const XDisplay&) = delete;

  const std::string& name() const { return name_; }  ///< for $DISPLAY
  _XDisplay* connection() const { return connection_; }
  pid_t server() const { return server_.pid(); }

  /// The visible window of a process whose title contains that text, or 0.
  Window find_window(pid_t process, const std::string& title = "") const;

  /// Later calls are about this window. It gets the keyboard's focus.
  void use(Window window);
  Window window() const { return window_; }
  Point size() const;
  Point on_screen(Point p) const;

  /// Names of X with modifiers before them: "a", "F2", "Home", "comma", "ctrl+shift+c". As long as a person holds it.
  void key(const std::string& keys);
  void key_down(const std::string& keys);
  void key_up(const std::string& keys);
  void type(const std::string& text);  ///< ASCII

  void move(Point to);
  void button_down(Button button = Button::left);
  void button_up(Button button = Button::left);
  void click(Point at, Button button = Button::left);
  void double_click(Point at);
  void drag(Point from, Point to, Button button = Button::left, int steps = 10);
  void scroll(int clicks);  ///< positive: away from the person

  void resize_window(int width, int height);
  void unmap();  ///< minimise
  void map();    ///< restore
  void close();  ///< asks the program to, as the button in a title bar does
  void focus();
  void take_focus();  ///< no window has it

  Image8 capture() const;

  /// The text that a program has put there; empty where none has.
  std::string clipboard() const;

 private:
  void press(int button, bool down);
  void set_minimised(bool minimised);
  void flush(double then_sleep_s = 0.0);

  Child server_;
  std::string name_;
  _XDisplay* connection_ = nullptr;
  Window window_ = 0;
};

}  // namespace izb::test
