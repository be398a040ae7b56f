// SPDX-License-Identifier: MIT
#include "gpu/program.h"

#include "base/error.h"
#include "gl/gl_test.h"
#include "gl/shader_folder.h"
#include "shadow/renderer.h"

namespace {

using namespace izb::gpu;

struct Programs : izb::test::ShaderFolder {
  std::string refusal(const ProgramSpec& spec) {
    try {
      Program program(spec);
    } catch (const izb::Error& e) {
      return e.what();
    }
    return {};
  }
};

constexpr const char* counting = R"(#version 450 core
#include "size.h"
layout(local_size_x = 8, local_size_y = 4) in;
layout(std430, binding = 0) buffer Out { uint hits[]; };
void main() {
  if (gl_GlobalInvocationID.x < width && gl_GlobalInvocationID.y < HEIGHT)
    hits[gl_GlobalInvocationID.y * width + gl_GlobalInvocationID.x] += 1u;
}
)";

TEST_F(Programs, IncludesAndDefinesReachTheDriverAndDispatchCoversTheSize) {
  write("size.h", "const uint width = 19u;\n");
  write("count.comp.glsl", counting);
  const Program program({"count", {"count.comp.glsl"}, {{"HEIGHT", "7u"}}});
  Buffer hits("hits", std::vector<uint32_t>(19 * 7 + 1, 0));
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, hits.name());
  program.dispatch(19, 7, 8, 4);
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  std::vector<uint32_t> expected(19 * 7, 1);
  expected.push_back(0);
  EXPECT_EQ(hits.read<uint32_t>(expected.size()), expected);
}

TEST_F(Programs, AMistakeIsToldWithFileAndLine) {
  write("size.h", "const uint width = 19u;\n\nconst float wrong = vec2(1.0);\n");
  write("count.comp.glsl", counting);
  const std::string in_header = refusal({"count", {"count.comp.glsl"}, {{"HEIGHT", "7u"}}});
  EXPECT_NE(in_header.find("size.h:3: "), std::string::npos) << in_header;
  write("size.h", "const uint width = 19u;\n");
  const std::string in_file = refusal({"count", {"count.comp.glsl"}, {}});  // HEIGHT is missing
  EXPECT_NE(in_file.find("count.comp.glsl:6: "), std::string::npos) << in_file;
  EXPECT_NE(in_file.find("'count'"), std::string::npos) << in_file;
}

TEST_F(Programs, AFileOfNoKindIsRefused) {
  write("a.txt", "#version 450 core\nvoid main() {}\n");
  EXPECT_EQ(refusal({"text", {"a.txt"}, {}}), "shader a.txt has no kind in its name");
}

TEST_F(Programs, AFileWithoutVersionIsRefused) {
  write("a.comp.glsl", "layout(local_size_x = 1) in;\nvoid main() {}\n");
  EXPECT_EQ(refusal({"a", {"a.comp.glsl"}, {}}), "a.comp.glsl:1: a shader begins with '#version 450 core'");
}

// Those that need none are given to it by layout_test.
TEST(RendererPrograms, TheDriverTakesThoseForItsExtensions) {
  std::string lacking;
  for (const ProgramSpec& spec : izb::Renderer::program_specs()) {
    if (spec.extensions.empty()) continue;
    if (const std::string first = izb::test::first_lacking(spec.extensions); !first.empty())
      lacking = first;
    else
      EXPECT_NO_THROW(Program program(spec)) << spec.label;
  }
  if (!lacking.empty()) GTEST_SKIP() << "this driver has no " << lacking;
}

}  // namespace
