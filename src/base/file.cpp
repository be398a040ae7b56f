// SPDX-License-Identifier: MIT
#include "base/file.h"

#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <memory>

#include "base/error.h"

namespace izb {
namespace fs = std::filesystem;
namespace {

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

template <typename Bytes>
Bytes read_file(const fs::path& path) {
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) fail("cannot read '{}': it is a directory", path.string());
  const std::unique_ptr<std::FILE, CloseFile> file(std::fopen(path.c_str(), "rb"));
  if (!file) fail("cannot read '{}': {}", path.string(), std::strerror(errno));

  // Read to the end rather than to the stated size, which pipes do not have.
  const std::uintmax_t size = fs::is_regular_file(path, ignored) ? fs::file_size(path, ignored) : 0;
  Bytes bytes(ignored ? 0 : size, typename Bytes::value_type{});
  size_t used = 0;
  for (;;) {
    if (used == bytes.size()) {
      const int next = std::fgetc(file.get());
      if (next == EOF) break;
      bytes.resize(used + (size_t(1) << 16) + used / 2);
      bytes[used++] = typename Bytes::value_type(next);
    }
    const size_t got = std::fread(bytes.data() + used, 1, bytes.size() - used, file.get());
    used += got;
    if (got == 0) break;
  }
  if (std::ferror(file.get())) fail("cannot read '{}': {}", path.string(), std::strerror(errno));
  bytes.resize(used);
  return bytes;
}

/// A name in the target's folder that no other call and no other running process uses.
fs::path temporary_beside(const fs::path& target) {
  static std::atomic<unsigned> count{0};
  return target.parent_path() / fmt::format(".izb-{}-{}.tmp", getpid(), count++);
}

}  // namespace

std::vector<std::byte> read_binary_file(const fs::path& path) {
  return read_file<std::vector<std::byte>>(path);
}

std::string read_text_file(const fs::path& path) {
  return read_file<std::string>(path);
}

AtomicFile::AtomicFile(fs::path target) : target_(std::move(target)), final_(target_) {
  std::error_code error;
  if (fs::is_symlink(target_, error)) final_ = fs::weakly_canonical(target_, error);
  const fs::file_status status = fs::status(final_, error);
  if (target_.filename().empty() || fs::is_directory(status)) {
    fail("cannot write '{}': it is a directory", target_.string());
  }

  if (fs::exists(status) && !fs::is_regular_file(status)) {
    file_ = std::fopen(final_.c_str(), "wb");
  } else {
    // A rename would get round the write protection of an old file.
    if (fs::exists(status) && access(final_.c_str(), W_OK) != 0) fail_writing();
    const fs::path folder = final_.has_parent_path() ? final_.parent_path() : fs::path(".");
    if (!fs::exists(folder, error)) {
      fail("cannot write '{}': the folder '{}' does not exist", target_.string(), folder.string());
    }
    temporary_ = temporary_beside(final_);
    file_ = std::fopen(temporary_.c_str(), "wbx");
  }
  if (!file_) fail_writing();
}

AtomicFile::~AtomicFile() {
  if (file_) std::fclose(file_);
  if (!temporary_.empty()) unlink(temporary_.c_str());
}

void AtomicFile::fail_writing() const {
  fail("cannot write '{}': {}", target_.string(), std::strerror(errno));
}

void AtomicFile::write(std::span<const std::byte> bytes) {
  if (bytes.empty()) return;  // their address may be null, which fwrite must not see
  if (std::fwrite(bytes.data(), 1, bytes.size(), file_) != bytes.size()) fail_writing();
}

void AtomicFile::commit() {
  std::FILE* file = std::exchange(file_, nullptr);
  if (std::fclose(file) != 0) fail_writing();
  if (temporary_.empty()) return;
  if (std::rename(temporary_.c_str(), final_.c_str()) != 0) fail_writing();
  temporary_.clear();
}

void write_file_atomically(const fs::path& path, std::span<const std::byte> bytes) {
  AtomicFile file(path);
  file.write(bytes);
  file.commit();
}

void write_file_atomically(const fs::path& path, std::string_view text) {
  write_file_atomically(path, std::as_bytes(std::span(text)));
}

}  // namespace izb
