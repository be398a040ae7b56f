// SPDX-License-Identifier: MIT
// GLFW with a hidden window: for machines whose only GL comes with a display.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include "base/error.h"
#include "gpu/context.h"

namespace izb::gpu {
namespace {

void* get_proc_address(const char* name) {
  return reinterpret_cast<void*>(glfwGetProcAddress(name));
}

std::string last_error() {
  const char* text = nullptr;
  glfwGetError(&text);
  return text ? text : "no reason given";
}

class GlfwContext final : public Context {
 public:
  explicit GlfwContext(bool debug) {
    if (!glfwInit()) fail("cannot initialise GLFW ({})", last_error());
    glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_CONTEXT_ROBUSTNESS, GLFW_LOSE_CONTEXT_ON_RESET);  // where there is no such thing, as it is
    glfwWindowHint(GLFW_OPENGL_DEBUG_CONTEXT, debug ? GLFW_TRUE : GLFW_FALSE);
    window_ = glfwCreateWindow(64, 64, "izb", nullptr, nullptr);
    if (!window_) {
      const std::string reason = last_error();
      glfwTerminate();
      fail("no window with OpenGL 4.5 core ({})", reason);
    }
    glfwMakeContextCurrent(window_);
    load_gl(get_proc_address);
  }
  ~GlfwContext() override {
    glfwDestroyWindow(window_);
    glfwTerminate();
  }

 private:
  GLFWwindow* window_ = nullptr;
};

}  // namespace

std::unique_ptr<Context> create_glfw_context(bool debug) {
  return std::make_unique<GlfwContext>(debug);
}

}  // namespace izb::gpu
