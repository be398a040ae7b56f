// SPDX-License-Identifier: MIT
// A window that writes what reaches it as a report of docs/VIEW.md's form, for the test of the tests' own hands.
// Keys: Ctrl+C copies the text of --copy, A aborts, Q ends without `closed`, S says something on stderr.
#include <GLFW/glfw3.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

namespace {

using nlohmann::json;

std::ofstream report;
std::string copied;
int pictures = 0;

void say(const char* event, json line = json::object()) {
  static const auto start = std::chrono::steady_clock::now();
  line["event"] = event;
  line["t_s"] = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  report << line.dump() << std::endl;
}

/// Red above, blue below, the lower left quarter green.
void paint(GLFWwindow* window) {
  int width = 0, height = 0;
  glfwGetFramebufferSize(window, &width, &height);
  const auto fill = [&](int x, int y, int w, int h, float r, float g, float b) {
    glScissor(x, y, w, h);
    glClearColor(r, g, b, 1.0f);
    glClear(GL_COLOR_BUFFER_BIT);
  };
  glViewport(0, 0, width, height);
  glEnable(GL_SCISSOR_TEST);
  fill(0, height / 2, width, height, 1, 0, 0);
  fill(0, 0, width, height / 2, 0, 0, 1);
  fill(0, 0, width / 2, height / 2, 0, 1, 0);
  glfwSwapBuffers(window);
}

/// A coarse picture of the motion, then one at rest.
void picture() {
  say("answer", {{"input", "key"}, {"ms", 1.0}});
  for (const double scale : {0.5, 1.0})
    say("picture", {{"serial", ++pictures}, {"scale", scale}, {"motion", scale < 1.0}, {"frame_ms", 1.0}});
  say("rest", {{"serial", pictures}});
}

void on_key(GLFWwindow* window, int key, int, int action, int mods) {
  const char* name = glfwGetKeyName(key, 0);
  say("key", {{"key", name ? name : std::to_string(key)}, {"action", action}, {"mods", mods}});
  if (action != GLFW_PRESS) return;
  if (key == GLFW_KEY_C && mods == GLFW_MOD_CONTROL) glfwSetClipboardString(window, copied.c_str());
  if (key == GLFW_KEY_A && mods == 0) std::abort();
  if (key == GLFW_KEY_Q && mods == 0) std::exit(0);
  if (key == GLFW_KEY_S && mods == 0) std::fputs("echo_window: a sentence\n", stderr);
  picture();
}

}  // namespace

int main(int argc, char** argv) {
  for (int i = 1; i + 1 < argc; ++i) {
    if (argv[i] == std::string("--report")) report.open(argv[i + 1]);
    if (argv[i] == std::string("--copy")) copied = argv[i + 1];
  }
  if (!glfwInit()) return 1;
  GLFWwindow* const window = glfwCreateWindow(300, 200, "echo", nullptr, nullptr);
  if (!window) return 1;
  glfwMakeContextCurrent(window);
  glfwSetKeyCallback(window, on_key);
  glfwSetCharCallback(window, [](GLFWwindow*, unsigned c) { say("char", {{"code", c}}); });
  glfwSetCursorPosCallback(window, [](GLFWwindow*, double x, double y) { say("move", {{"x", x}, {"y", y}}); });
  glfwSetMouseButtonCallback(window, [](GLFWwindow* w, int button, int action, int mods) {
    double x = 0.0, y = 0.0;
    glfwGetCursorPos(w, &x, &y);
    say("button", {{"button", button}, {"action", action}, {"mods", mods}, {"x", x}, {"y", y}});
  });
  glfwSetScrollCallback(window, [](GLFWwindow*, double, double y) { say("scroll", {{"y", y}}); });
  glfwSetDropCallback(window, [](GLFWwindow*, int count, const char** paths) {
    say("drop", {{"paths", std::vector<std::string>(paths, paths + count)}});
  });
  glfwSetWindowSizeCallback(window, [](GLFWwindow*, int w, int h) { say("size", {{"window", {w, h}}}); });
  glfwSetWindowIconifyCallback(window, [](GLFWwindow*, int minimised) { say("iconify", {{"minimised", minimised}}); });
  glfwSetWindowFocusCallback(window, [](GLFWwindow*, int focused) { say("focus", {{"focused", focused}}); });
  paint(window);
  say("opened");
  say("widgets", {{"rects", {{"a button", {10, 20, 50, 40}}}}});
  say("state", {{"state", {{"number", 7}}}});
  while (!glfwWindowShouldClose(window)) {
    glfwWaitEvents();
    paint(window);
  }
  say("closed");
  glfwTerminate();
}
