// SPDX-License-Identifier: MIT
// Every program that the renderer can compile, through glslang; and what a mistake in a shader file is told
// as.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "base/error.h"
#include "chosen_programs.h"

namespace {

namespace fs = std::filesystem;
using izb::gpu::ProgramSpec;

const fs::path glsl = IZB_SOURCE_DIR "/glsl";

std::string describe(const ProgramSpec& spec) {
  std::string text = spec.label;
  for (const auto& [name, value] : spec.defines) text += " " + name + "=" + value;
  return text;
}

/// The message of check_program, or "" if it finds nothing.
std::string complaint(const ProgramSpec& spec) {
  try {
    izb::gpu::check_program(spec);
  } catch (const izb::Error& e) {
    return e.what();
  }
  return {};
}

/// The number of the line that begins with `text`, from 1.
int line_of(const fs::path& file, const std::string& text) {
  std::ifstream in(file);
  int number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    if (line.starts_with(text)) return number;
  }
  return 0;
}

TEST(Programs, OfEveryDefinePassGlslang) {
  const std::vector<ProgramSpec> specs = izb::test::chosen_programs();
  ASSERT_GE(specs.size(), 10u);
  for (const ProgramSpec& spec : specs) EXPECT_EQ(complaint(spec), "") << describe(spec);
}

/// Files that are numbered by their stage hold an entry point; the others are included.
TEST(Programs, EveryShaderFileBelongsToOne) {
  std::set<std::string> used, present;
  for (const ProgramSpec& spec : izb::Renderer::program_specs()) used.insert(spec.files.begin(), spec.files.end());
  for (const auto& entry : fs::recursive_directory_iterator(glsl))
    if (std::isdigit(entry.path().filename().string()[0])) present.insert(entry.path().lexically_relative(glsl));
  EXPECT_EQ(used, present);
}

TEST(Programs, LabelsAndDefinesTellThemApart) {
  std::set<std::string> seen;
  for (const ProgramSpec& spec : izb::Renderer::program_specs())
    EXPECT_TRUE(seen.insert(describe(spec)).second) << describe(spec);
}

/// A copy of the shader folder in which a mistake is planted.
struct Planted : testing::Test {
  const fs::path folder = fs::path(testing::TempDir()) / ("izb_glsl_test_" + std::to_string(getpid()));
  const ProgramSpec build{"build", {"shadow/izb/3_build.comp.glsl"}, {}};
  Planted() {
    fs::copy(glsl, folder, fs::copy_options::recursive);
    setenv("IZB_GLSL", folder.c_str(), 1);
  }
  ~Planted() override {
    unsetenv("IZB_GLSL");
    fs::remove_all(folder);
  }
  /// Puts `text` in front of the line that begins with `anchor` and returns the number of its first line.
  int plant(const std::string& file, const std::string& anchor, const std::string& text) {
    const int at = line_of(folder / file, anchor);
    EXPECT_GT(at, 0) << anchor;
    std::ifstream in(folder / file);
    std::ostringstream out;
    int number = 0;
    for (std::string line; std::getline(in, line);) {
      if (++number == at) out << text << "\n";
      out << line << "\n";
    }
    in.close();
    std::ofstream(folder / file) << out.str();
    return at;
  }
};

TEST_F(Planted, TheCopyItselfIsGood) {
  EXPECT_EQ(complaint(build), "");
}

TEST_F(Planted, AMistakeIsToldWithFileAndLine) {
  const std::string file = build.files[0];
  const int line = plant(file, "void main()", "int mistake = undeclared_name;");
  const std::string message = complaint(build);
  EXPECT_NE(message.find(file + ":" + std::to_string(line) + ": "), std::string::npos) << message;
  EXPECT_NE(message.find("undeclared_name"), std::string::npos) << message;
}

TEST_F(Planted, DefinesDoNotMoveTheLines) {
  ProgramSpec spec = build;
  spec.defines = {{"ONE", "1"}, {"TWO", "2"}};
  const int line = plant(spec.files[0], "void main()", "int mistake = undeclared_name;");
  EXPECT_NE(complaint(spec).find(spec.files[0] + ":" + std::to_string(line) + ": "), std::string::npos)
      << complaint(spec);
}

TEST_F(Planted, AMistakeInAnIncludedFileIsToldWithThatFile) {
  const int line = plant("shared/lists.h", "const uint no_node", "const uint mistake = undeclared_name;");
  const std::string message = complaint(build);
  EXPECT_NE(message.find("shared/lists.h:" + std::to_string(line) + ": "), std::string::npos) << message;
}

TEST_F(Planted, AMistakeAfterAnIncludeKeepsItsLine) {
  const std::string file = "shared/light.h";  // it includes another file itself
  const int line = plant(file, "const float unit_roundoff", "const float mistake = undeclared_name;");
  const std::string message = complaint(build);
  EXPECT_NE(message.find(file + ":" + std::to_string(line) + ": "), std::string::npos) << message;
}

TEST_F(Planted, AMissingIncludeIsNamed) {
  const int line = plant(build.files[0], "void main()", "#include \"shared/absent.h\"");
  const std::string message = complaint(build);
  EXPECT_NE(message.find(build.files[0] + ":" + std::to_string(line) + ": "), std::string::npos) << message;
  EXPECT_NE(message.find("shared/absent.h"), std::string::npos) << message;
}

TEST_F(Planted, AMissingShaderFileIsNamed) {
  fs::remove(folder / build.files[0]);
  const std::string message = complaint(build);
  EXPECT_NE(message.find((folder / build.files[0]).string()), std::string::npos) << message;
}

TEST_F(Planted, WhatOnlyLinkingFindsIsRefused) {
  const ProgramSpec spec{"zcull", {"shadow/izb/4_zcull.vert.glsl", "shadow/izb/4_zcull.frag.glsl"}, {}};
  ASSERT_EQ(complaint(spec), "");
  plant(spec.files[1], "void main()", "float without_body();\nfloat mistake = without_body();");
  EXPECT_NE(complaint(spec).find("without_body"), std::string::npos) << complaint(spec);
}

}  // namespace
