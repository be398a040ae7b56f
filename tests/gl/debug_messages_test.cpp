// SPDX-License-Identifier: MIT
// The count on which every GL test relies: it grows with an error, and with nothing else.
#include <gtest/gtest.h>

#include "gl/gl_test.h"
#include "gpu/gl.h"

namespace {

using izb::gpu::debug_message_count;

TEST(DebugMessages, AnErrorIsCounted) {
  const int before = debug_message_count();
  glBindTextureUnit(0, 0xdeadu);  // no such texture
  EXPECT_EQ(debug_message_count(), before + 1);
  EXPECT_EQ(glGetError(), GLenum(GL_INVALID_OPERATION));
  izb::test::expect_debug_messages(1);
}

TEST(DebugMessages, GoodCallsAreSilent) {
  const int before = debug_message_count();
  GLuint name = 0;
  glCreateTextures(GL_TEXTURE_2D, 1, &name);
  glTextureStorage2D(name, 1, GL_RGBA8, 4, 4);
  glBindTextureUnit(0, name);
  glDeleteTextures(1, &name);
  EXPECT_EQ(debug_message_count(), before);
}

}  // namespace
