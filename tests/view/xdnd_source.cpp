// SPDX-License-Identifier: MIT
#include "view/xdnd_source.h"

#include <X11/Xatom.h>
#include <X11/Xlib.h>

#include <algorithm>
#include <cctype>
#include <optional>
#include <stdexcept>

namespace izb::test {
namespace {

constexpr long version = 5;
constexpr double timeout_s = 30.0;

class Drag {
 public:
  Drag(XDisplay& display, std::string text)
      : x_(display.connection()),
        target_(display.window()),
        source_(XCreateSimpleWindow(x_, DefaultRootWindow(x_), 0, 0, 1, 1, 0, 0, 0)),
        text_(std::move(text)) {}
  ~Drag() { XDestroyWindow(x_, source_); }
  Drag(const Drag&) = delete;
  Drag& operator=(const Drag&) = delete;

  bool drop(Point screen) {
    const long its_version = target_version();
    if (its_version < 3) throw std::runtime_error("the window takes no drops");
    XSetSelectionOwner(x_, atom("XdndSelection"), source_, CurrentTime);
    send("XdndEnter", std::min(version, its_version) << 24, long(atom("text/uri-list")), None, None);
    send("XdndPosition", 0, (long(screen.x) << 16) | screen.y, CurrentTime, long(atom("XdndActionCopy")));
    if ((wait_for("XdndStatus").data.l[1] & 1) == 0) {
      send("XdndLeave", 0, 0, 0, 0);
      return false;
    }
    send("XdndDrop", 0, CurrentTime, 0, 0);
    return wait_for("XdndFinished").data.l[1] != 0;  // bit 0 should say it; GLFW 3.3 gives the number of bytes it took
  }

 private:
  Atom atom(const char* name) const { return XInternAtom(x_, name, False); }

  /// 0: it takes no drops.
  long target_version() const {
    Atom type = None;
    int format = 0;
    unsigned long count = 0, rest = 0;
    unsigned char* data = nullptr;
    XGetWindowProperty(x_, target_, atom("XdndAware"), 0, 1, False, XA_ATOM, &type, &format, &count, &rest, &data);
    const long found = data && count == 1 ? *reinterpret_cast<const long*>(data) : 0;
    if (data) XFree(data);
    return found;
  }

  void send(const char* message, long a, long b, long c, long d) {
    XEvent event{};
    event.xclient.type = ClientMessage;
    event.xclient.window = target_;
    event.xclient.message_type = atom(message);
    event.xclient.format = 32;
    const long values[] = {long(source_), a, b, c, d};
    std::copy(std::begin(values), std::end(values), event.xclient.data.l);
    XSendEvent(x_, target_, False, NoEventMask, &event);
    XFlush(x_);
  }

  /// Serves the list meanwhile.
  XClientMessageEvent wait_for(const char* message) {
    std::optional<XClientMessageEvent> found;
    wait_until(timeout_s, [&] {
      XEvent event;
      while (XCheckTypedWindowEvent(x_, source_, SelectionRequest, &event)) serve(event.xselectionrequest);
      while (!found && XCheckTypedWindowEvent(x_, source_, ClientMessage, &event))
        if (event.xclient.message_type == atom(message)) found = event.xclient;
      return found.has_value();
    });
    if (!found) throw std::runtime_error("the window does not answer with " + std::string(message));
    return *found;
  }

  void serve(const XSelectionRequestEvent& request) {
    const bool known = request.target == atom("text/uri-list");
    if (known)
      XChangeProperty(x_, request.requestor, request.property, request.target, 8, PropModeReplace,
                      reinterpret_cast<const unsigned char*>(text_.data()), int(text_.size()));
    XEvent event{};
    event.xselection.type = SelectionNotify;
    event.xselection.requestor = request.requestor;
    event.xselection.selection = request.selection;
    event.xselection.target = request.target;
    event.xselection.property = known ? request.property : None;
    event.xselection.time = request.time;
    XSendEvent(x_, request.requestor, False, NoEventMask, &event);
    XFlush(x_);
  }

  Display* const x_;
  const Window target_, source_;
  const std::string text_;
};

}  // namespace

std::string uri_list(const std::vector<std::filesystem::path>& files) {
  std::string text;
  for (const std::filesystem::path& file : files) {
    text += "file://";
    for (const char c : std::filesystem::absolute(file).string()) {
      const auto byte = static_cast<unsigned char>(c);
      if (byte < 0x80 && (std::isalnum(byte) || std::string("/-._~").find(c) != std::string::npos)) {
        text += c;
      } else {
        constexpr char digits[] = "0123456789ABCDEF";
        text += {'%', digits[byte >> 4], digits[byte & 15]};
      }
    }
    text += "\r\n";
  }
  return text;
}

bool drop_files(XDisplay& display, const std::vector<std::filesystem::path>& files, Point at) {
  display.move(at);
  return Drag(display, uri_list(files)).drop(display.on_screen(at));
}

}  // namespace izb::test
