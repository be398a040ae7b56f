// SPDX-License-Identifier: MIT
// Linked programs kept on disk, so that a later start neither checks, compiles nor links them (OpenGL 4.5 core,
// section 7.5).
#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>

#include "gpu/gl.h"
#include "gpu/glsl_front_end.h"

namespace izb::gpu {

/// $IZB_PROGRAM_CACHE, or izb/programs below $XDG_CACHE_HOME or ~/.cache. None if it is "off", or if none of the three
/// is set.
std::optional<std::filesystem::path> program_cache_folder();

/// The place of one program of the current context in the cache. Its name is a hash of all that decides what the driver
/// makes of it: the texts, the defines, and what the driver says of itself. What cannot be read, was damaged or is
/// refused by the driver is as if it were not there, and what cannot be written is not kept: the program is compiled.
class CachedProgram {
 public:
  explicit CachedProgram(const ProgramSpec& spec);

  /// False if it is not there: `program` is then to be linked.
  bool load(GLuint program) const;
  /// To be called before the program is linked.
  void announce(GLuint program) const;
  void store(GLuint program) const;

  /// Empty: there is no cache, or the driver gives no binaries.
  const std::filesystem::path& file() const { return file_; }

 private:
  std::filesystem::path file_;
};

/// Removes the programs that were not used for longest until the folder's hold at most `limit_bytes`.
void trim_program_cache(const std::filesystem::path& folder, uint64_t limit_bytes);

}  // namespace izb::gpu
