// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdlib>
#include <optional>

#include "base/error.h"
#include "gl/gl_test.h"
#include "gpu/context.h"
#include "gpu/gl.h"

namespace izb::test {
namespace {

std::optional<gpu::ContextResult> context;
gpu::Capabilities driver;
int expected_messages = 0;

/// Not made for --gtest_list_tests.
class ContextEnvironment final : public testing::Environment {
  void SetUp() override {
    const char* name = std::getenv("IZB_TEST_CONTEXT");
    try {
      context = gpu::create_context(name ? name : "egl", true);
    } catch (const Error& e) {
      FAIL() << e.what();
    }
    gpu::enable_debug_messages();
    driver = gpu::query_capabilities();
  }
  void TearDown() override { context.reset(); }
};

class MessageListener final : public testing::EmptyTestEventListener {
  void OnTestStart(const testing::TestInfo&) override {
    before_ = gpu::debug_message_count();
    expected_messages = 0;
  }
  void OnTestEnd(const testing::TestInfo&) override {
    if (!context) return;
    const int messages = gpu::debug_message_count() - before_;
    if (messages != expected_messages)
      ADD_FAILURE() << messages << " GL errors or messages of high severity, expected " << expected_messages;
    if (const GLenum error = glGetError(); error != GL_NO_ERROR && expected_messages == 0)
      ADD_FAILURE() << "glGetError() says " << error;
  }
  int before_ = 0;
};

}  // namespace

const gpu::Capabilities& capabilities() {
  return driver;
}

void expect_debug_messages(int count) {
  expected_messages = count;
}

}  // namespace izb::test

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  testing::AddGlobalTestEnvironment(new izb::test::ContextEnvironment);
  // In front of the printer, so that its failures are printed with the test.
  testing::TestEventListeners& listeners = testing::UnitTest::GetInstance()->listeners();
  testing::TestEventListener* printer = listeners.Release(listeners.default_result_printer());
  listeners.Append(printer);
  listeners.Append(new izb::test::MessageListener);
  return RUN_ALL_TESTS();
}
