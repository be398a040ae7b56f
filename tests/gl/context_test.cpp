// SPDX-License-Identifier: MIT
#include "gpu/context.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <functional>

#include "base/error.h"
#include "gpu/capabilities.h"
#include "gpu/gl.h"

namespace {

using namespace izb::gpu;

/// The message of the izb::Error that making this context throws, or "".
std::string refusal(const std::string& name) {
  try {
    create_context(name, true);
  } catch (const izb::Error& e) {
    return e.what();
  }
  return {};
}

bool missing_from_build(const std::string& message) {
  return message.find("this build has no") != std::string::npos;
}

void hide_display() {
  unsetenv("DISPLAY");
  unsetenv("WAYLAND_DISPLAY");
}

class HeadlessContext : public testing::TestWithParam<const char*> {};

TEST_P(HeadlessContext, IsCoreProfile45AndWorks) {
  hide_display();
  if (missing_from_build(refusal(GetParam()))) GTEST_SKIP() << "this build has no " << GetParam();
  const ContextResult result = create_context(GetParam(), true);
  EXPECT_EQ(result.name, GetParam());
  ASSERT_EQ(result.attempts.size(), 1u);
  EXPECT_EQ(result.attempts[0].name, GetParam());
  EXPECT_EQ(result.attempts[0].failure, "");
  GLint major = 0, minor = 0, profile = 0;
  glGetIntegerv(GL_MAJOR_VERSION, &major);
  glGetIntegerv(GL_MINOR_VERSION, &minor);
  glGetIntegerv(GL_CONTEXT_PROFILE_MASK, &profile);
  EXPECT_GE(major * 10 + minor, 45);
  EXPECT_TRUE(profile & GL_CONTEXT_CORE_PROFILE_BIT);
  enable_debug_messages();
  const Capabilities capabilities = query_capabilities();
  EXPECT_FALSE(capabilities.renderer.empty());
  EXPECT_GE(capabilities.max_texture_size, 4096);
  EXPECT_GE(capabilities.subpixel_bits, 4);
  EXPECT_EQ(debug_message_count(), 0);
}

TEST_P(HeadlessContext, CanBeMadeAgainAfterItsEnd) {
  hide_display();
  if (missing_from_build(refusal(GetParam()))) GTEST_SKIP() << "this build has no " << GetParam();
  for (int i = 0; i < 3; ++i) {
    const ContextResult result = create_context(GetParam(), false);
    EXPECT_NE(glGetString(GL_VERSION), nullptr);
  }
}

INSTANTIATE_TEST_SUITE_P(, HeadlessContext, testing::Values("egl", "osmesa"),
                         [](const auto& test) { return std::string(test.param); });

TEST(Context, GlfwWithoutADisplayIsRefusedWithTheReason) {
  hide_display();
  const std::string message = refusal("glfw");
  if (missing_from_build(message)) GTEST_SKIP() << "this build has no GLFW";
  EXPECT_TRUE(message.starts_with("no OpenGL 4.5 context (glfw: ")) << message;
  EXPECT_NE(message.find("GLFW"), std::string::npos) << message;
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
}

TEST(Context, AnUnknownNameIsWrongUsage) {
  try {
    create_context("vulkan", false);
    FAIL() << "taken";
  } catch (const izb::UsageError& e) {
    EXPECT_STREQ(e.what(), "unknown context 'vulkan'");
  }
}

TEST(Context, AutoTriesInTheStatedOrderAndReportsEveryAttempt) {
  EXPECT_EQ(context_names(), (std::vector<std::string>{"auto", "egl", "osmesa", "glfw"}));
  const ContextResult result = create_context("auto", false);
  ASSERT_FALSE(result.attempts.empty());
  EXPECT_EQ(result.attempts.back().name, result.name);
  EXPECT_EQ(result.attempts.back().failure, "");
  const std::vector<std::string> order = context_names();
  for (size_t i = 0; i < result.attempts.size(); ++i) {
    EXPECT_EQ(result.attempts[i].name, order[i + 1]);
    if (i + 1 < result.attempts.size()) {
      EXPECT_NE(result.attempts[i].failure, "");
    }
  }
}

/// Drivers read their environment once a process, so these run in one of their own; `check` says what is
/// wrong, or "".
class OwnProcess : public testing::Test {
 protected:
  void run(const std::function<std::string()>& check) {
    testing::FLAGS_gtest_death_test_style = "threadsafe";
    EXPECT_EXIT(
        {
          const std::string wrong = check();
          fmt::print(stderr, "{}\n", wrong.empty() ? "good" : wrong);
          _exit(0);
        },
        testing::ExitedWithCode(0), "^good");
  }
};

TEST_F(OwnProcess, AutoGoesOnWhenEglFails) {
  run([]() -> std::string {
    hide_display();
    setenv("__EGL_VENDOR_LIBRARY_FILENAMES", "/nonexistent.json", 1);
    if (missing_from_build(refusal("osmesa"))) return "";
    const ContextResult result = create_context("auto", false);
    if (result.name != "osmesa") return "taken: " + result.name;
    if (result.attempts.size() != 2 || result.attempts[0].name != "egl") return "attempts are not egl, osmesa";
    return result.attempts[0].failure.empty() ? "no reason why EGL failed" : "";
  });
}

/// Runs an X server without a screen on a display that was free; empty if there is none to run.
class VirtualDisplay {
 public:
  VirtualDisplay() {
    int ends[2];
    if (pipe(ends) != 0) return;
    server_ = fork();
    if (server_ == 0) {
      // The server chooses a free display and writes its number; of those that others have it complains.
      if (std::freopen("/dev/null", "w", stderr) == nullptr) _exit(126);
      const std::string end = std::to_string(ends[1]);
      execlp("Xvfb", "Xvfb", "-displayfd", end.c_str(), "-screen", "0", "640x480x24", "-nolisten", "tcp", nullptr);
      _exit(127);
    }
    close(ends[1]);
    std::string digits;
    for (char c; read(ends[0], &c, 1) == 1 && c != '\n';) digits += c;
    close(ends[0]);
    if (!digits.empty()) name_ = ":" + digits;
  }
  ~VirtualDisplay() {
    if (server_ <= 0) return;
    kill(server_, SIGTERM);
    waitpid(server_, nullptr, 0);
  }
  VirtualDisplay(const VirtualDisplay&) = delete;
  VirtualDisplay& operator=(const VirtualDisplay&) = delete;
  const std::string& name() const { return name_; }

 private:
  pid_t server_ = -1;
  std::string name_;
};

TEST_F(OwnProcess, GlfwWorksOnADisplay) {
  if (std::system("command -v Xvfb >/dev/null") != 0) GTEST_SKIP() << "no Xvfb";
  if (missing_from_build(refusal("glfw"))) GTEST_SKIP() << "this build has no GLFW";
  run([]() -> std::string {
    const VirtualDisplay display;
    if (display.name().empty()) return "Xvfb does not start";
    hide_display();
    setenv("DISPLAY", display.name().c_str(), 1);
    const ContextResult result = create_context("glfw", true);
    enable_debug_messages();
    GLint major = 0, minor = 0;
    glGetIntegerv(GL_MAJOR_VERSION, &major);
    glGetIntegerv(GL_MINOR_VERSION, &minor);
    if (result.name != "glfw" || major * 10 + minor < 45) return "no OpenGL 4.5";
    return debug_message_count() == 0 ? "" : "GL reported an error";
  });
}

TEST_F(OwnProcess, WithoutGl45EveryAttemptIsNamed) {
  run([]() -> std::string {
    hide_display();
    // Mesa's drivers then claim a version that is too low; others do not heed it.
    setenv("MESA_GL_VERSION_OVERRIDE", "3.3", 1);
    const std::string message = refusal("auto");
    if (message.empty()) {
      const ContextResult result = create_context("auto", false);
      const std::string version(reinterpret_cast<const char*>(glGetString(GL_VERSION)));
      return version.find("Mesa") == std::string::npos ? "" : "taken: " + version;
    }
    if (!message.starts_with("no OpenGL 4.5 context (")) return message;
    for (const char* name : {"egl: ", "osmesa: ", "glfw: "})
      if (message.find(name) == std::string::npos) return message;
    return "";
  });
}

}  // namespace
