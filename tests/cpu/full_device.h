// SPDX-License-Identifier: MIT
#pragma once
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <optional>

/// A device on which every write fails with "No space left on device", or nothing where there is none. Root
/// gets a node of its own in `folder`: code that wrongly renames over its target could destroy the machine's
/// /dev/full.
inline std::optional<std::filesystem::path> full_device(const std::filesystem::path& folder) {
  if (geteuid() != 0) {
    if (std::filesystem::is_character_file("/dev/full")) return "/dev/full";
    return std::nullopt;
  }
  const std::filesystem::path own = folder / "full";
  if (mknod(own.c_str(), S_IFCHR | 0666, makedev(1, 7)) != 0) return std::nullopt;
  std::FILE* file = std::fopen(own.c_str(), "wb");  // fails on file systems that allow no devices
  if (!file) return std::nullopt;
  std::fclose(file);
  return own;
}
