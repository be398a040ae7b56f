// SPDX-License-Identifier: MIT
#include "app/outputs.h"

#include "base/error.h"

namespace izb {
namespace fs = std::filesystem;

AtomicFile* Outputs::open(const std::string& option, const std::string& path) {
  if (path.empty()) return nullptr;
  std::error_code ignored;
  const fs::file_status status = fs::status(path, ignored);
  if (!fs::exists(status) || fs::is_regular_file(status)) {
    const auto [other, is_new] = taken_.try_emplace(fs::weakly_canonical(path, ignored), option);
    if (!is_new) throw UsageError(fmt::format("{} and {} name the same file, '{}'", other->second, option, path));
  }
  return &files_.emplace_back(path);
}

void Outputs::commit() {
  for (AtomicFile& file : files_) file.close();
  for (AtomicFile& file : files_) file.commit();
}

}  // namespace izb
