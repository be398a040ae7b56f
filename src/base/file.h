// SPDX-License-Identifier: MIT
// Whole files in, whole files out: a result appears completely or not at all.
#pragma once
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace izb {

/// All bytes of a file. Throws izb::Error if it is missing, a directory, a device or unreadable.
std::vector<std::byte> read_binary_file(const std::filesystem::path& path);

/// The same as text; bytes are not converted.
std::string read_text_file(const std::filesystem::path& path);

/// A file being written. The bytes go to a temporary name in the target's folder; commit() renames it.
/// Without commit() the temporary is removed and an old file of that name stays as it was. A target that is
/// not a regular file (a device, a pipe) is written directly, since a rename would replace it. Open it before
/// long work to learn early whether the output can be written at all.
class AtomicFile {
 public:
  /// Throws izb::Error if the folder is missing, the target is a directory, or either cannot be written.
  explicit AtomicFile(std::filesystem::path target);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Appends bytes. Throws izb::Error, e.g. if the disk is full.
  void write(std::span<const std::byte> bytes);

  /// Flushes and closes: after it, only commit() is left to do. Throws izb::Error, e.g. if the disk is full.
  void close();

  /// close(), and the file appears under its name. Throws izb::Error if any of it fails.
  void commit();

  /// As given, for messages.
  const std::filesystem::path& target() const { return target_; }

 private:
  [[noreturn]] void fail_writing() const;

  std::filesystem::path target_;     ///< as given, for messages
  std::filesystem::path final_;      ///< symbolic links resolved
  std::filesystem::path temporary_;  ///< empty: `final_` is written directly, or the rename has happened
  int signal_slot_ = -1;             ///< where the signal handler finds `temporary_`; -1: nowhere
  std::FILE* file_ = nullptr;
};

/// From now on SIGINT, SIGTERM and SIGHUP remove the temporaries of this process before they end it.
void remove_temporaries_on_signals();

/// Removes from the folder, not from those in it, what AtomicFile left there when its process was killed; what belongs
/// to a process that runs stays. Only for a folder that no other machine and no other container writes to: their
/// processes are not seen here.
void remove_stale_temporaries(const std::filesystem::path& folder);

/// Writes all of a file, or throws izb::Error and leaves what was there.
void write_file_atomically(const std::filesystem::path& path, std::span<const std::byte> bytes);
void write_file_atomically(const std::filesystem::path& path, std::string_view text);

}  // namespace izb
