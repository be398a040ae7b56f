// SPDX-License-Identifier: MIT
#include "gpu/program_cache.h"

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "base/error.h"
#include "base/file.h"
#include "base/sha256.h"

namespace izb::gpu {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view extension = ".program";
constexpr std::string_view magic = "izb program 1\n";
/// All programs of all options take about 100 MB with Mesa 22.3.
constexpr uint64_t limit_bytes = uint64_t(256) << 20;

/// Stands in front of the driver's bytes.
struct Head {
  char magic[14];
  char sha256[64];  ///< of the driver's bytes
  char unused[2];
  GLenum format;
};
static_assert(sizeof(Head) == 84 && magic.size() == sizeof Head::magic);

std::string sha256_hex_of(std::string_view text) {
  return sha256_hex(std::as_bytes(std::span(text)));
}

std::vector<GLenum> formats() {
  GLint count = 0;
  glGetIntegerv(GL_NUM_PROGRAM_BINARY_FORMATS, &count);
  std::vector<GLint> all(static_cast<size_t>(std::max(count, 0)));
  if (!all.empty()) glGetIntegerv(GL_PROGRAM_BINARY_FORMATS, all.data());
  return {all.begin(), all.end()};
}

/// What the driver says of itself: another must not get what it has made. (It checks, too.)
std::string driver_text() {
  std::string text;
  for (const GLenum name : {GL_VENDOR, GL_RENDERER, GL_VERSION, GL_SHADING_LANGUAGE_VERSION})
    if (const auto* said = reinterpret_cast<const char*>(glGetString(name))) text += fmt::format("{}\n", said);
  return text;
}

}  // namespace

std::optional<fs::path> program_cache_folder() {
  const auto set = [](const char* name) -> const char* {
    const char* value = std::getenv(name);
    return value && *value ? value : nullptr;
  };
  if (const char* folder = set("IZB_PROGRAM_CACHE")) {
    if (std::strcmp(folder, "off") == 0) return std::nullopt;
    return folder;
  }
  if (const char* cache = set("XDG_CACHE_HOME")) return fs::path(cache) / "izb" / "programs";
  if (const char* home = set("HOME")) return fs::path(home) / ".cache" / "izb" / "programs";
  return std::nullopt;
}

CachedProgram::CachedProgram(const ProgramSpec& spec) {
  const std::optional<fs::path> folder = program_cache_folder();
  if (!folder || formats().empty()) return;
  file_ = *folder / (sha256_hex_of(driver_text() + program_text(spec)).substr(0, 40) + std::string(extension));
}

bool CachedProgram::load(GLuint program) const {
  std::error_code error;
  if (file_.empty() || !fs::is_regular_file(file_, error)) return false;
  std::vector<std::byte> bytes;
  try {
    bytes = read_binary_file(file_);
  } catch (const std::exception&) {
    return false;
  }
  Head head;
  if (bytes.size() <= sizeof head) return false;
  std::memcpy(&head, bytes.data(), sizeof head);
  const std::span<const std::byte> binary = std::span(bytes).subspan(sizeof head);
  const std::vector<GLenum> taken = formats();
  if (std::string_view(head.magic, sizeof head.magic) != magic ||
      std::string_view(head.sha256, sizeof head.sha256) != sha256_hex(binary) ||
      std::find(taken.begin(), taken.end(), head.format) == taken.end())
    return false;
  glProgramBinary(program, head.format, binary.data(), static_cast<GLsizei>(binary.size()));
  GLint linked = 0;
  glGetProgramiv(program, GL_LINK_STATUS, &linked);
  if (linked) fs::last_write_time(file_, fs::file_time_type::clock::now(), error);  // the time of its last use
  return linked;
}

void CachedProgram::announce(GLuint program) const {
  if (!file_.empty()) glProgramParameteri(program, GL_PROGRAM_BINARY_RETRIEVABLE_HINT, GL_TRUE);
}

void CachedProgram::store(GLuint program) const {
  if (file_.empty()) return;
  GLint length = 0;
  glGetProgramiv(program, GL_PROGRAM_BINARY_LENGTH, &length);
  if (length <= 0) return;
  std::vector<std::byte> bytes(sizeof(Head) + static_cast<size_t>(length));
  Head head{};
  GLsizei written = 0;
  glGetProgramBinary(program, length, &written, &head.format, bytes.data() + sizeof head);
  if (written <= 0) return;
  bytes.resize(sizeof head + static_cast<size_t>(written));
  magic.copy(head.magic, sizeof head.magic);
  sha256_hex(std::span(bytes).subspan(sizeof head)).copy(head.sha256, sizeof head.sha256);
  std::memcpy(bytes.data(), &head, sizeof head);
  try {
    std::error_code error;
    fs::create_directories(file_.parent_path(), error);
    static std::atomic<bool> trimmed{false};
    if (!trimmed.exchange(true)) trim_program_cache(file_.parent_path(), limit_bytes);
    write_file_atomically(file_, bytes);
  } catch (const std::exception&) {  // a full disk, a folder of another person: it goes without
  }
}

void trim_program_cache(const fs::path& folder, uint64_t limit) {
  struct Kept {
    fs::path path;
    fs::file_time_type used;
    uint64_t bytes;
  };
  std::error_code error;
  remove_stale_temporaries(folder);
  std::vector<Kept> all;
  uint64_t bytes = 0;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    std::error_code gone;  // by another process that trims
    Kept kept{at->path(), at->last_write_time(gone), at->file_size(gone)};
    if (gone || kept.path.extension() != extension) continue;
    bytes += kept.bytes;
    all.push_back(std::move(kept));
  }
  std::sort(all.begin(), all.end(), [](const Kept& a, const Kept& b) { return a.used < b.used; });
  for (size_t i = 0; i < all.size() && bytes > limit; ++i) {
    fs::remove(all[i].path, error);
    bytes -= all[i].bytes;
  }
}

}  // namespace izb::gpu
