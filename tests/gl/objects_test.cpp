// SPDX-License-Identifier: MIT
#include "gpu/objects.h"

#include <dlfcn.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <numeric>
#include <type_traits>

#include "base/error.h"
#include "gl/gl_test.h"
#include "gpu/context.h"

namespace {

using namespace izb::gpu;

static_assert(!std::is_copy_constructible_v<Buffer> && !std::is_copy_assignable_v<Buffer>);

template <typename Action>
std::string error_of(Action action) {
  try {
    action();
  } catch (const izb::Error& error) {
    return error.what();
  }
  return {};
}

TEST(Buffer, KeepsItsContents) {
  std::vector<uint32_t> data(1000);
  std::iota(data.begin(), data.end(), 7u);
  Buffer buffer("numbers", data);
  EXPECT_EQ(buffer.bytes(), 4000u);
  EXPECT_EQ(buffer.read<uint32_t>(1000), data);

  const std::vector<uint32_t> patch{1, 2, 3};
  buffer.update(8, 12, patch.data());
  std::copy(patch.begin(), patch.end(), data.begin() + 2);
  EXPECT_EQ(buffer.read<uint32_t>(1000), data);

  buffer.fill(0xabcd1234u);
  EXPECT_EQ(buffer.read<uint32_t>(1000), std::vector<uint32_t>(1000, 0xabcd1234u));
}

TEST(Buffer, SmallAndEmptyOnesCanBeBound) {
  const Buffer empty("empty", std::vector<uint32_t>{});
  EXPECT_EQ(empty.bytes(), 16u);
  const Buffer small("small", std::vector<uint32_t>{5});
  EXPECT_EQ(small.read<uint32_t>(1), std::vector<uint32_t>{5});
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, empty.name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, small.name());
}

TEST(Readings, OfAContextThatTheDriverHasResetAreRefused) {
  const Buffer buffer("numbers", std::vector<uint32_t>{5});
  const Texture texture("texels", GL_R32UI, 2, 2);
  const auto driver = glGetGraphicsResetStatus;
  for (const auto& [status, reason] : {std::pair<PFNGLGETGRAPHICSRESETSTATUSPROC, const char*>{
                                           [] { return GLenum{GL_GUILTY_CONTEXT_RESET}; }, "this program's context"},
                                       {[] { return GLenum{GL_INNOCENT_CONTEXT_RESET}; }, "another program"},
                                       {[] { return GLenum{GL_UNKNOWN_CONTEXT_RESET}; }, "a reason unknown"}}) {
    glGetGraphicsResetStatus = status;
    const std::string of_buffer = error_of([&] { buffer.read<uint32_t>(1); });
    const std::string of_texture = error_of([&] { texture.read<uint32_t>(GL_RED_INTEGER, GL_UNSIGNED_INT, 1); });
    glGetGraphicsResetStatus = driver;
    EXPECT_NE(of_buffer.find(reason), std::string::npos) << of_buffer;
    EXPECT_EQ(of_buffer, of_texture);
  }
  EXPECT_EQ(buffer.read<uint32_t>(1), std::vector<uint32_t>{5});
}

TEST(Object, MovesOwnership) {
  Buffer a("a", std::vector<uint32_t>{1, 2, 3, 4});
  const GLuint name = a.name();
  Buffer b(std::move(a));
  EXPECT_FALSE(a);  // NOLINT(bugprone-use-after-move): this is what is tested
  EXPECT_EQ(b.name(), name);
  Buffer c("c", 64);
  c = std::move(b);
  EXPECT_EQ(c.name(), name);
  EXPECT_EQ(c.bytes(), 16u);
  EXPECT_EQ(c.read<uint32_t>(4), (std::vector<uint32_t>{1, 2, 3, 4}));
}

TEST(Texture, ClearsAndReadsBack) {
  Texture texture("counts", GL_R32UI, 37, 5);
  texture.clear_uint(9);
  EXPECT_EQ(texture.read_uint(), std::vector<uint32_t>(37 * 5, 9));
  EXPECT_EQ(texture.bytes(), 37u * 5u * 4u);
  EXPECT_EQ(texture.width_px(), 37);
  EXPECT_EQ(texture.height_px(), 5);
}

TEST(Texture, ReadsRowsWithoutPadding) {
  // Three bytes a row: GL would pad rows to four if it were not told otherwise.
  const Texture texture("bytes", GL_R8, 3, 2);
  const std::vector<uint8_t> data{1, 2, 3, 4, 5, 6};
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTextureSubImage2D(texture.name(), 0, 0, 0, 3, 2, GL_RED, GL_UNSIGNED_BYTE, data.data());
  EXPECT_EQ(texture.read<uint8_t>(GL_RED, GL_UNSIGNED_BYTE, 1), data);
}

TEST(Texture, CountsTheBytesOfAllLevels) {
  EXPECT_EQ(Texture("levels", GL_RGBA8, 8, 4, 4).bytes(), 4u * (32 + 8 + 2 + 1));
}

TEST(Texture, ASizeBeyondTheDriversIsRefused) {
  const int too_large = static_cast<int>(izb::test::capabilities().max_texture_size) + 1;
  const std::string message = error_of([&] { Texture("vast", GL_R8, too_large, 1); });
  EXPECT_NE(message.find("'vast'"), std::string::npos) << message;
  EXPECT_NE(message.find(std::to_string(too_large)), std::string::npos) << message;
  izb::test::expect_debug_messages(1);
}

/// The label as a debugger asks for it; izb's own function table does without that function.
std::string label_of(GLenum kind, GLuint name) {
  const char* context = std::getenv("IZB_TEST_CONTEXT");
  const bool osmesa = context && std::string(context) == "osmesa";
  const auto get_proc_address =
      reinterpret_cast<GetProcAddress>(dlsym(RTLD_DEFAULT, osmesa ? "OSMesaGetProcAddress" : "eglGetProcAddress"));
  if (!get_proc_address) return "no get-proc-address";
  const auto get_label = reinterpret_cast<PFNGLGETOBJECTLABELPROC>(get_proc_address("glGetObjectLabel"));
  char text[64] = {};
  get_label(kind, name, sizeof text, nullptr, text);
  return text;
}

TEST(Object, HasTheLabelThatItWasGiven) {
  const Buffer buffer("a label", 16);
  const Texture texture("another", GL_R8, 1, 1);
  EXPECT_EQ(label_of(GL_BUFFER, buffer.name()), "a label");
  EXPECT_EQ(label_of(GL_TEXTURE, texture.name()), "another");
  EXPECT_EQ(label_of(GL_VERTEX_ARRAY, VertexArray("array").name()), "array");
  EXPECT_EQ(label_of(GL_QUERY, Query("query", GL_TIMESTAMP).name()), "query");
  EXPECT_EQ(label_of(GL_SAMPLER, Sampler("sampler").name()), "sampler");
  EXPECT_EQ(label_of(GL_FRAMEBUFFER, Framebuffer("framebuffer", {&texture}, nullptr).name()), "framebuffer");
}

TEST(Framebuffer, DrawsIntoItsTextures) {
  const Texture color("color", GL_RGBA32F, 4, 4), depth("depth", GL_DEPTH_COMPONENT32F, 4, 4);
  const Framebuffer framebuffer("both", {&color}, &depth);
  const float value[4] = {0.25f, 0.5f, 0.75f, 1.0f}, z = 0.125f;
  glClearNamedFramebufferfv(framebuffer.name(), GL_COLOR, 0, value);
  glClearNamedFramebufferfv(framebuffer.name(), GL_DEPTH, 0, &z);
  const std::vector<float> read = color.read<float>(GL_RGBA, GL_FLOAT, 4);
  for (size_t i = 0; i < read.size(); ++i) EXPECT_EQ(read[i], value[i % 4]);
  EXPECT_EQ(depth.read<float>(GL_DEPTH_COMPONENT, GL_FLOAT, 1), std::vector<float>(16, z));
}

TEST(Framebuffer, AnIncompleteOneIsRefusedByName) {
  const Texture depth("depth", GL_DEPTH_COMPONENT32F, 4, 4);
  const std::string message = error_of([&] { Framebuffer("depth as colour", {&depth}, nullptr); });
  EXPECT_NE(message.find("'depth as colour' incomplete"), std::string::npos) << message;
}

}  // namespace
