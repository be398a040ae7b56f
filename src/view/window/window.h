// SPDX-License-Identifier: MIT
// The window: GLFW, its GL context, and Dear ImGui on both.
#pragma once
#include <chrono>
#include <string>
#include <vector>

#include "app/frame_options.h"

struct GLFWwindow;

namespace izb {

/// GLFW's numbers of the keys that are no character.
namespace keys {
inline constexpr int escape = 256, tab = 258, home = 268, f1 = 290, f2 = 291, f3 = 292, f4 = 293, f5 = 294;
}  // namespace keys

class Window {
 public:
  /// Throws izb::Error that says why there can be none.
  Window(const std::string& title, Size size);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  /// Waits for input at most that long, and begins a frame of the interface. False where there is nothing to draw on:
  /// minimised, or without a pixel.
  bool begin_frame(double wait_s);
  /// Draws the frame and shows it.
  void end_frame();
  bool closing() const;

  Size size() const;          ///< in the window's coordinates, which the mouse has, too
  Size framebuffer() const;   ///< in pixels
  float pixel_ratio() const;  ///< pixels for a unit of the window's coordinates
  bool focused() const;
  std::string renderer() const;

  std::vector<std::string> take_dropped();  ///< files that were dragged in
  void set_clipboard(const std::string& text);
  /// From any thread: begin_frame() waits no longer.
  static void wake();

  /// Input that the frame shown last answered: its kind, and how long it may have waited at most: from the frame
  /// before, if it was there when the events were asked for.
  struct Answer {
    std::string input;
    double ms;
  };
  std::vector<Answer> take_answers();

 private:
  using Clock = std::chrono::steady_clock;
  struct Input {
    const char* kind;
    Clock::time_point since;
  };

  static Window& of(GLFWwindow* window);
  void note_input(const char* kind);
  void install_callbacks();
  void fit_scale();

  GLFWwindow* window_ = nullptr;
  float content_scale_ = 0.0f;
  std::vector<std::string> dropped_;
  std::vector<Input> inputs_;
  std::vector<Answer> answers_;
  Clock::time_point frame_start_ = Clock::now(), asked_ = Clock::now();
};

}  // namespace izb
