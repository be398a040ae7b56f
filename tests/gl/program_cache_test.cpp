// SPDX-License-Identifier: MIT
// Programs from the cache on disk do what the compiled ones do, and only where nothing has changed.
#include "gpu/program_cache.h"

#include <chrono>
#include <cstring>
#include <map>
#include <vector>

#include "base/error.h"
#include "base/file.h"
#include "base/sha256.h"
#include "gl/shader_folder.h"
#include "gpu/program.h"

namespace {

namespace fs = std::filesystem;
using namespace izb::gpu;

constexpr const char* filling = R"(#version 450 core
#include "value.h"
#ifdef MORE
#include "more.h"
#else
const uint more = 0u;
#endif
layout(local_size_x = 4) in;
layout(std430, binding = 0) buffer Out { uint values[]; };
void main() {
  if (gl_GlobalInvocationID.x < 4u) values[gl_GlobalInvocationID.x] = value + more;
}
)";

struct ProgramCache : izb::test::ShaderFolder {
  const fs::path cache = folder / "cache" / "programs";
  ProgramSpec spec{"fill", {"fill.comp.glsl"}, {}};

  ProgramCache() {
    setenv("IZB_PROGRAM_CACHE", cache.c_str(), 1);
    write("value.h", "const uint value = 7u;\n");
    write("more.h", "const uint more = 20u;\n");
    write("fill.comp.glsl", filling);
  }
  void SetUp() override {
    if (CachedProgram(spec).file().empty()) GTEST_SKIP() << "this driver gives no program binaries";
  }

  std::vector<fs::path> kept() const {
    std::vector<fs::path> files;
    if (fs::is_directory(cache))
      for (const auto& entry : fs::directory_iterator(cache)) files.push_back(entry.path());
    return files;
  }
  /// What the program fills a buffer with.
  static uint32_t value_of(const Program& program) {
    const Buffer values("values", std::vector<uint32_t>(5, 99));
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, values.name());
    program.dispatch(4, 1, 4, 1);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    const std::vector<uint32_t> read = values.read<uint32_t>(5);
    EXPECT_EQ(read[4], 99u);
    for (int i = 1; i < 4; ++i) EXPECT_EQ(read[size_t(i)], read[0]);
    return read[0];
  }
  /// Makes the program and says whether it was there.
  void expect(bool there, uint32_t value) const {
    const Program program(spec);
    EXPECT_EQ(program.from_cache(), there);
    EXPECT_EQ(value_of(program), value);
  }
};

TEST_F(ProgramCache, KeepsWhatWasCompiled) {
  expect(false, 7);
  ASSERT_EQ(kept().size(), 1u);
  EXPECT_EQ(kept()[0], CachedProgram(spec).file());
  expect(true, 7);
  spec.label = "another name for the same";
  expect(true, 7);
  EXPECT_EQ(kept().size(), 1u);
}

TEST_F(ProgramCache, AChangeOfFileIncludeOrDefineIsAnotherProgram) {
  expect(false, 7);
  write("value.h", "const uint value = 8u;\n");
  expect(false, 8);
  spec.defines = {{"MORE", "1"}};
  expect(false, 28);
  write("more.h", "const uint more = 30u;\n");
  expect(false, 38);
  write("fill.comp.glsl", std::string(filling) + "// to its end\n");
  expect(false, 38);
  expect(true, 38);
  write("fill.comp.glsl", filling);
  write("more.h", "const uint more = 20u;\n");
  expect(true, 28);
  spec.defines = {};
  write("value.h", "const uint value = 7u;\n");
  expect(true, 7);
}

TEST_F(ProgramCache, AMistakeIsToldEachTime) {
  for (int i = 0; i < 2; ++i) {
    write("value.h", "const uint value = wrong;\n");
    EXPECT_THROW(Program{spec}, izb::Error);
    EXPECT_TRUE(kept().empty());
  }
}

TEST_F(ProgramCache, ADamagedFileIsCompiledAndReplaced) {
  expect(false, 7);
  const fs::path file = kept().at(0);
  const std::vector<std::byte> whole = izb::read_binary_file(file);
  std::vector<size_t> places{0, 13, 14, 77, 80, 83, 84, whole.size() / 2, whole.size() - 1};
  for (const size_t place : places) {
    SCOPED_TRACE(place);
    std::vector<std::byte> damaged = whole;
    damaged[place] ^= std::byte(0x10);
    izb::write_file_atomically(file, damaged);
    expect(false, 7);
    EXPECT_EQ(izb::read_binary_file(file), whole);
    damaged.resize(place);
    izb::write_file_atomically(file, std::span<const std::byte>(damaged));
    expect(false, 7);
    expect(true, 7);
  }
}

TEST_F(ProgramCache, ABinaryThatTheDriverRefusesIsCompiledAndReplaced) {
  expect(false, 7);
  const fs::path file = kept().at(0);
  spec.defines = {{"MORE", "1"}};
  // The driver's bytes of no program, with a hash that is theirs.
  std::vector<std::byte> bytes = izb::read_binary_file(file);
  const std::vector<std::byte> nothing(bytes.size() - 84, std::byte(0));
  const std::string hash = izb::sha256_hex(nothing);
  std::memcpy(bytes.data() + 14, hash.data(), hash.size());
  std::copy(nothing.begin(), nothing.end(), bytes.begin() + 84);
  izb::write_file_atomically(CachedProgram(spec).file(), bytes);
  expect(false, 27);
  expect(true, 27);
}

TEST_F(ProgramCache, GoesWithoutWhereItCannotWrite) {
  write("cache", "a file");
  expect(false, 7);
  expect(false, 7);
  EXPECT_EQ(izb::read_text_file(folder / "cache"), "a file");
}

TEST_F(ProgramCache, OffIsOff) {
  setenv("IZB_PROGRAM_CACHE", "off", 1);
  EXPECT_FALSE(program_cache_folder());
  expect(false, 7);
  expect(false, 7);
  EXPECT_FALSE(fs::exists(folder / "off"));
}

TEST_F(ProgramCache, LiesBelowTheCacheFolderOfThePerson) {
  const char* names[] = {"IZB_PROGRAM_CACHE", "XDG_CACHE_HOME", "HOME"};
  std::map<std::string, std::string> before;
  for (const char* name : names)
    if (const char* value = std::getenv(name)) before[name] = value;
  setenv("IZB_PROGRAM_CACHE", "", 1);
  setenv("XDG_CACHE_HOME", "/somewhere", 1);
  setenv("HOME", "/nowhere", 1);
  EXPECT_EQ(program_cache_folder(), "/somewhere/izb/programs");
  unsetenv("XDG_CACHE_HOME");
  EXPECT_EQ(program_cache_folder(), "/nowhere/.cache/izb/programs");
  unsetenv("HOME");
  EXPECT_EQ(program_cache_folder(), std::nullopt);
  for (const auto& [name, value] : before) setenv(name.c_str(), value.c_str(), 1);
}

TEST_F(ProgramCache, IsTrimmedOfWhatWasNotUsedForLongest) {
  fs::create_directories(cache);
  const auto now = fs::file_time_type::clock::now();
  for (int i = 0; i < 4; ++i) {
    const fs::path file = cache / (std::to_string(i) + ".program");
    std::ofstream(file) << std::string(100, 'x');
    fs::last_write_time(file, now - std::chrono::hours(i == 2 ? 9 : i));
  }
  std::ofstream(cache / "of somebody else") << std::string(1000, 'x');
  trim_program_cache(cache, 400);
  EXPECT_EQ(kept().size(), 5u);
  trim_program_cache(cache, 399);
  EXPECT_FALSE(fs::exists(cache / "2.program"));
  EXPECT_EQ(kept().size(), 4u);
  trim_program_cache(cache, 100);
  EXPECT_TRUE(fs::exists(cache / "0.program"));
  EXPECT_TRUE(fs::exists(cache / "of somebody else"));
  EXPECT_EQ(kept().size(), 2u);
  trim_program_cache(folder / "absent", 0);
}

TEST_F(ProgramCache, UseMakesAProgramYoung) {
  expect(false, 7);
  const fs::path file = kept().at(0);
  const auto old = fs::file_time_type::clock::now() - std::chrono::hours(1);
  fs::last_write_time(file, old);
  expect(true, 7);
  EXPECT_GT(fs::last_write_time(file), old + std::chrono::minutes(30));
}

}  // namespace
