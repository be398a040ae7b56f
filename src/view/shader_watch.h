// SPDX-License-Identifier: MIT
// Notices that a shader's file was saved.
#pragma once
#include <filesystem>
#include <map>

namespace izb {

class ShaderWatch {
 public:
  explicit ShaderWatch(std::filesystem::path folder) : folder_(std::move(folder)), seen_(read()) {}
  /// Whether a file below the folder was written, made or removed since the last call.
  bool changed();

 private:
  using Times = std::map<std::filesystem::path, std::filesystem::file_time_type>;
  Times read() const;

  std::filesystem::path folder_;
  Times seen_;
};

}  // namespace izb
