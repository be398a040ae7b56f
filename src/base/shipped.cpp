// SPDX-License-Identifier: MIT
#include "base/shipped.h"

#include <system_error>

#include "base/error.h"

namespace izb {

std::filesystem::path shipped_path(const std::string& installed, const std::string& source, const std::string& hint) {
  namespace fs = std::filesystem;
  std::error_code ignored;
  const fs::path program = fs::read_symlink("/proc/self/exe", ignored);
  const fs::path beside = program.parent_path().parent_path() / IZB_INSTALLED_DATA / installed;
  if (fs::exists(beside, ignored)) return beside;
  const fs::path tree = fs::path(IZB_SOURCE_TREE) / source;
  if (fs::exists(tree, ignored)) return tree;
  fail("a part of the program is neither at '{}' nor at '{}': {}", beside.string(), tree.string(), hint);
}

}  // namespace izb
