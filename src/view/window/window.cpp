// SPDX-License-Identifier: MIT
#include "view/window/window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <algorithm>

#include "base/error.h"
#include "gpu/context.h"
#include "gpu/gl.h"

namespace izb {
namespace {

static_assert(keys::escape == GLFW_KEY_ESCAPE && keys::tab == GLFW_KEY_TAB && keys::home == GLFW_KEY_HOME);
static_assert(keys::f1 == GLFW_KEY_F1 && keys::f5 == GLFW_KEY_F5);

std::string last_error() {
  const char* text = nullptr;
  glfwGetError(&text);
  return text ? text : "no reason given";
}

void* get_proc_address(const char* name) {
  return reinterpret_cast<void*>(glfwGetProcAddress(name));
}

}  // namespace

Window::Window(const std::string& title, Size size) {
  if (!glfwInit()) fail("no window can be opened ({})", last_error());
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_CONTEXT_ROBUSTNESS, GLFW_LOSE_CONTEXT_ON_RESET);
  glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
  window_ = glfwCreateWindow(size.width_px, size.height_px, title.c_str(), nullptr, nullptr);
  if (!window_) {
    const std::string reason = last_error();
    glfwTerminate();
    fail("no window with OpenGL 4.5 core can be opened ({})", reason);
  }
  glfwMakeContextCurrent(window_);
  gpu::load_gl(get_proc_address);
  // A software renderer has no retrace to wait for, and the picture's thread needs the time.
  glfwSwapInterval(renderer().find("llvmpipe") == std::string::npos ? 1 : 0);
  glfwSetWindowUserPointer(window_, this);
  install_callbacks();
  ImGui::CreateContext();
  ImGui::GetIO().IniFilename = nullptr;         // closing saves nothing
  ImGui_ImplGlfw_InitForOpenGL(window_, true);  // it calls the callbacks that are there
  ImGui_ImplOpenGL3_Init("#version 450 core");
  fit_scale();
}

Window::~Window() {
  ImGui_ImplOpenGL3_Shutdown();
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
  glfwDestroyWindow(window_);
  glfwTerminate();
}

Window& Window::of(GLFWwindow* window) {
  return *static_cast<Window*>(glfwGetWindowUserPointer(window));
}

void Window::install_callbacks() {
  glfwSetKeyCallback(window_, [](GLFWwindow* w, int, int, int, int) { of(w).note_input("key"); });
  glfwSetMouseButtonCallback(window_, [](GLFWwindow* w, int, int, int) { of(w).note_input("button"); });
  glfwSetScrollCallback(window_, [](GLFWwindow* w, double, double) { of(w).note_input("scroll"); });
  glfwSetCursorPosCallback(window_, [](GLFWwindow* w, double, double) { of(w).note_input("move"); });
  glfwSetFramebufferSizeCallback(window_, [](GLFWwindow* w, int, int) { of(w).note_input("resize"); });
  glfwSetDropCallback(window_, [](GLFWwindow* w, int count, const char** paths) {
    of(w).dropped_.insert(of(w).dropped_.end(), paths, paths + count);
    of(w).note_input("drop");
  });
}

void Window::note_input(const char* kind) {
  if (std::any_of(inputs_.begin(), inputs_.end(), [&](const Input& i) { return i.kind == kind; })) return;
  // What is there at once came at some time since the frame before was begun.
  const auto now = Clock::now();
  inputs_.push_back({kind, now - asked_ < std::chrono::milliseconds(1) ? frame_start_ : now});
}

// Fonts and sizes for the monitor's scale; again when the window moves to another.
void Window::fit_scale() {
  float x = 1.0f, y = 1.0f;
  glfwGetWindowContentScale(window_, &x, &y);
  // Where a unit of the window's coordinates is several pixels (Wayland, macOS) the system has scaled already.
  const float scale = std::clamp(std::max(x, y) / pixel_ratio(), 1.0f, 4.0f);
  if (scale == content_scale_) return;
  content_scale_ = scale;
  ImGuiIO& io = ImGui::GetIO();
  io.Fonts->Clear();
  ImFontConfig config;
  config.SizePixels = std::round(13.0f * scale);
  io.Fonts->AddFontDefault(&config);
  ImGui_ImplOpenGL3_DestroyFontsTexture();  // the next frame makes another
  ImGui_ImplOpenGL3_CreateFontsTexture();
  ImGuiStyle style;
  ImGui::StyleColorsDark(&style);
  style.WindowRounding = 4.0f;
  style.FrameRounding = 3.0f;
  style.Colors[ImGuiCol_WindowBg].w = 0.88f;
  style.ScaleAllSizes(scale);
  ImGui::GetStyle() = style;
}

bool Window::begin_frame(double wait_s) {
  asked_ = Clock::now();
  if (wait_s > 0.0)
    glfwWaitEventsTimeout(wait_s);
  else
    glfwPollEvents();
  frame_start_ = Clock::now();
  const Size pixels = framebuffer();
  if (glfwGetWindowAttrib(window_, GLFW_ICONIFIED) || pixels.width_px < 1 || pixels.height_px < 1) {
    inputs_.clear();
    return false;
  }
  fit_scale();
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  ImGui::NewFrame();
  return true;
}

void Window::end_frame() {
  ImGui::Render();
  const Size pixels = framebuffer();
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glViewport(0, 0, pixels.width_px, pixels.height_px);
  glClearColor(0.08f, 0.08f, 0.09f, 1.0f);
  glClear(GL_COLOR_BUFFER_BIT);
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
  glfwSwapBuffers(window_);
  const auto now = Clock::now();
  for (const Input& input : inputs_)
    answers_.push_back({input.kind, std::chrono::duration<double, std::milli>(now - input.since).count()});
  inputs_.clear();
}

bool Window::closing() const {
  return glfwWindowShouldClose(window_);
}

Size Window::size() const {
  Size size{0, 0};
  glfwGetWindowSize(window_, &size.width_px, &size.height_px);
  return size;
}

Size Window::framebuffer() const {
  Size size{0, 0};
  glfwGetFramebufferSize(window_, &size.width_px, &size.height_px);
  return size;
}

float Window::pixel_ratio() const {
  const Size window = size(), pixels = framebuffer();
  return window.width_px > 0 ? float(pixels.width_px) / float(window.width_px) : 1.0f;
}

bool Window::focused() const {
  return glfwGetWindowAttrib(window_, GLFW_FOCUSED);
}

std::string Window::renderer() const {
  const auto* text = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  return text ? text : "";
}

std::vector<std::string> Window::take_dropped() {
  return std::exchange(dropped_, {});
}

void Window::set_clipboard(const std::string& text) {
  glfwSetClipboardString(window_, text.c_str());
}

void Window::wake() {
  glfwPostEmptyEvent();
}

std::vector<Window::Answer> Window::take_answers() {
  return std::exchange(answers_, {});
}

}  // namespace izb
