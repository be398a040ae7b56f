// SPDX-License-Identifier: MIT
// What a sweep needs to know of somebody's scene file without loading it.
#pragma once
#include <filesystem>
#include <string>

namespace izb::bench {

struct SceneFile {
  std::string sha256;     ///< of its bytes and of those of the files that it names: another scene has another
  bool animated = false;  ///< it holds animations
};

/// Throws izb::Error where the file cannot be read. What is no glTF has a digest all the same: the loader says why.
SceneFile look_into(const std::filesystem::path& path);

}  // namespace izb::bench
