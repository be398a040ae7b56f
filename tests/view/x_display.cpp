// SPDX-License-Identifier: MIT
#include "view/x_display.h"

#include <X11/XKBlib.h>
#include <X11/Xatom.h>
#include <X11/Xlib.h>
#include <X11/Xutil.h>
#include <X11/extensions/XTest.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <sstream>
#include <stdexcept>

namespace izb::test {
namespace {

constexpr double held_s = 0.06;     // a key or button; a program that looks once a picture must see it
constexpr double between_s = 0.02;  // steps of a drag

/// A window may be gone between two calls: that is an answer, not the end of the test.
int ignore(Display*, XErrorEvent*) {
  return 0;
}

struct Freed {
  void operator()(void* memory) const { XFree(memory); }
};

Atom atom(Display* display, const char* name) {
  return XInternAtom(display, name, False);
}

/// The bytes of a property of 8-bit values, or the longs of one of 32-bit values, as they lie in memory.
std::string property(Display* display, Window window, Atom name, bool remove = false) {
  Atom type = None;
  int format = 0;
  unsigned long count = 0, rest = 0;
  unsigned char* data = nullptr;
  if (XGetWindowProperty(display, window, name, 0, 1L << 24, remove, AnyPropertyType, &type, &format, &count, &rest,
                         &data) != Success ||
      !data)
    return {};
  const std::unique_ptr<unsigned char, Freed> owned(data);
  const size_t unit = format == 32 ? sizeof(long) : size_t(format / 8);
  return {reinterpret_cast<const char*>(data), count * unit};
}

std::vector<Window> children(Display* display, Window parent) {
  Window root = 0, its_parent = 0, *list = nullptr;
  unsigned count = 0;
  if (!XQueryTree(display, parent, &root, &its_parent, &list, &count) || !list) return {};
  const std::unique_ptr<Window, Freed> owned(list);
  return {list, list + count};
}

bool is_visible(Display* display, Window window) {
  XWindowAttributes attributes;
  return XGetWindowAttributes(display, window, &attributes) && attributes.map_state == IsViewable;
}

std::vector<KeySym> keysyms(const std::string& keys) {
  std::vector<KeySym> symbols;
  std::istringstream words(keys);
  for (std::string word; std::getline(words, word, '+');) {
    const KeySym symbol = word == "ctrl"    ? XK_Control_L
                          : word == "shift" ? XK_Shift_L
                          : word == "alt"   ? XK_Alt_L
                                            : XStringToKeysym(word.c_str());
    if (symbol == NoSymbol) throw std::runtime_error("no key is called '" + word + "'");
    symbols.push_back(symbol);
  }
  return symbols;
}

void send(Display* display, KeySym symbol, bool down) {
  const KeyCode code = XKeysymToKeycode(display, symbol);
  if (code == 0) throw std::runtime_error("the keyboard lacks " + std::string(XKeysymToString(symbol)));
  XTestFakeKeyEvent(display, code, down, CurrentTime);
}

}  // namespace

XDisplay::XDisplay()
    : server_({"Xvfb", "-displayfd", "1", "-screen", "0", "1280x800x24", "+extension", "GLX", "-noreset", "-nolisten",
               "tcp"}) {
  // It writes the number when it takes connections.
  wait_until(30.0, [&] { return server_.out().ends_with('\n') || !server_.runs(); });
  const std::string number = server_.out();
  if (!number.ends_with('\n')) throw std::runtime_error("Xvfb does not start: " + server_.err());
  name_ = ":" + number.substr(0, number.size() - 1);
  connection_ = XOpenDisplay(name_.c_str());
  if (!connection_) throw std::runtime_error("cannot connect to Xvfb at " + name_);
  XSetErrorHandler(ignore);
}

XDisplay::~XDisplay() {
  XCloseDisplay(connection_);
  server_.end();  // it removes its socket and lock
}

XDisplay::Window XDisplay::find_window(pid_t process, const std::string& title) const {
  const std::function<Window(Window)> below = [&](Window parent) -> Window {
    for (const Window window : children(connection_, parent)) {
      const std::string pid = property(connection_, window, atom(connection_, "_NET_WM_PID"));
      if (pid.size() == sizeof(long) && *reinterpret_cast<const long*>(pid.data()) == process &&
          is_visible(connection_, window) &&
          property(connection_, window, atom(connection_, "_NET_WM_NAME")).find(title) != std::string::npos)
        return window;
      if (const Window found = below(window)) return found;
    }
    return 0;
  };
  return below(DefaultRootWindow(connection_));
}

void XDisplay::use(Window window) {
  window_ = window;
  focus();
}

Point XDisplay::size() const {
  XWindowAttributes attributes;
  if (!XGetWindowAttributes(connection_, window_, &attributes)) throw std::runtime_error("the window is gone");
  return {attributes.width, attributes.height};
}

Point XDisplay::on_screen(Point p) const {
  Point at;
  ::Window child = 0;
  XTranslateCoordinates(connection_, window_, DefaultRootWindow(connection_), p.x, p.y, &at.x, &at.y, &child);
  return at;
}

void XDisplay::flush(double then_sleep_s) {
  XSync(connection_, False);
  if (!server_.runs()) throw std::runtime_error("Xvfb has ended: " + server_.err());
  sleep_s(then_sleep_s);
}

void XDisplay::key_down(const std::string& keys) {
  for (const KeySym symbol : keysyms(keys)) send(connection_, symbol, true);
  flush();
}

void XDisplay::key_up(const std::string& keys) {
  std::vector<KeySym> symbols = keysyms(keys);
  std::reverse(symbols.begin(), symbols.end());
  for (const KeySym symbol : symbols) send(connection_, symbol, false);
  flush();
}

void XDisplay::key(const std::string& keys) {
  key_down(keys);
  sleep_s(held_s);
  key_up(keys);
  sleep_s(between_s);
}

void XDisplay::type(const std::string& text) {
  for (const char c : text) {
    const KeySym symbol = c == '\n' ? XK_Return : KeySym(static_cast<unsigned char>(c));  // Latin 1 is its own keysym
    const KeyCode code = XKeysymToKeycode(connection_, symbol);
    const bool shift = code != 0 && XkbKeycodeToKeysym(connection_, code, 0, 0) != symbol;
    if (shift) send(connection_, XK_Shift_L, true);
    send(connection_, symbol, true);
    flush(between_s);
    send(connection_, symbol, false);
    if (shift) send(connection_, XK_Shift_L, false);
    flush(between_s);
  }
}

void XDisplay::move(Point to) {
  const Point at = on_screen(to);
  XTestFakeMotionEvent(connection_, DefaultScreen(connection_), at.x, at.y, CurrentTime);
  flush();
}

void XDisplay::press(int button, bool down) {
  XTestFakeButtonEvent(connection_, unsigned(button), down, CurrentTime);
  flush();
}

void XDisplay::button_down(Button button) {
  press(int(button), true);
}
void XDisplay::button_up(Button button) {
  press(int(button), false);
}

void XDisplay::click(Point at, Button button) {
  move(at);
  sleep_s(held_s);
  button_down(button);
  sleep_s(held_s);
  button_up(button);
  sleep_s(between_s);
}

void XDisplay::double_click(Point at) {
  click(at);
  button_down();
  sleep_s(held_s);
  button_up();
}

void XDisplay::drag(Point from, Point to, Button button, int steps) {
  move(from);
  sleep_s(held_s);
  button_down(button);
  sleep_s(held_s);
  for (int i = 1; i <= steps; ++i) {
    move({from.x + (to.x - from.x) * i / steps, from.y + (to.y - from.y) * i / steps});
    sleep_s(between_s);
  }
  sleep_s(held_s);
  button_up(button);
  sleep_s(between_s);
}

void XDisplay::scroll(int clicks) {
  const int button = clicks > 0 ? 4 : 5;
  for (int i = 0; i < std::abs(clicks); ++i) {
    press(button, true);
    press(button, false);
    sleep_s(between_s);
  }
}

void XDisplay::resize_window(int width, int height) {
  XResizeWindow(connection_, window_, unsigned(width), unsigned(height));
  flush();
}

void XDisplay::set_minimised(bool minimised) {
  const Atom state = atom(connection_, "WM_STATE");
  const long value[] = {minimised ? IconicState : NormalState, None};
  XChangeProperty(connection_, window_, state, state, 32, PropModeReplace,
                  reinterpret_cast<const unsigned char*>(value), 2);
  if (minimised)
    XUnmapWindow(connection_, window_);
  else
    XMapWindow(connection_, window_);
  flush();
}

void XDisplay::unmap() {
  set_minimised(true);
}

void XDisplay::map() {
  set_minimised(false);
  focus();
}

void XDisplay::close() {
  XEvent event{};
  event.xclient.type = ClientMessage;
  event.xclient.window = window_;
  event.xclient.message_type = atom(connection_, "WM_PROTOCOLS");
  event.xclient.format = 32;
  event.xclient.data.l[0] = long(atom(connection_, "WM_DELETE_WINDOW"));
  event.xclient.data.l[1] = CurrentTime;
  XSendEvent(connection_, window_, False, NoEventMask, &event);
  flush();
}

void XDisplay::focus() {
  if (!wait_until(10.0, [&] { return is_visible(connection_, window_); }))
    throw std::runtime_error("the window is not shown");
  XSetInputFocus(connection_, window_, RevertToParent, CurrentTime);
  flush(held_s);
}

void XDisplay::take_focus() {
  XSetInputFocus(connection_, None, RevertToNone, CurrentTime);
  flush(held_s);
}

Image8 XDisplay::capture() const {
  const Point its_size = size();
  XImage* const image =
      XGetImage(connection_, window_, 0, 0, unsigned(its_size.x), unsigned(its_size.y), AllPlanes, ZPixmap);
  if (!image) throw std::runtime_error("the window cannot be read: not all of it is on the screen");
  Image8 picture{its_size.x, its_size.y, 3, {}};
  picture.pixels.reserve(size_t(its_size.x) * size_t(its_size.y) * 3);
  for (int y = 0; y < its_size.y; ++y) {
    const char* bgrx = image->data + y * image->bytes_per_line;
    for (int x = 0; x < its_size.x; ++x, bgrx += 4)
      for (const int component : {2, 1, 0}) picture.pixels.push_back(uint8_t(bgrx[component]));
  }
  XDestroyImage(image);
  return picture;
}

std::string XDisplay::clipboard() const {
  const ::Window asking = XCreateSimpleWindow(connection_, DefaultRootWindow(connection_), 0, 0, 1, 1, 0, 0, 0);
  const Atom answer = atom(connection_, "IZB_TEST_CLIPBOARD");
  XConvertSelection(connection_, atom(connection_, "CLIPBOARD"), atom(connection_, "UTF8_STRING"), answer, asking,
                    CurrentTime);
  XEvent event{};
  const bool answered =
      wait_until(10.0, [&] { return XCheckTypedWindowEvent(connection_, asking, SelectionNotify, &event); });
  std::string text;
  if (answered && event.xselection.property != None) text = property(connection_, asking, answer, true);
  XDestroyWindow(connection_, asking);
  if (!answered) throw std::runtime_error("the clipboard's owner does not answer");
  return text;
}

}  // namespace izb::test
