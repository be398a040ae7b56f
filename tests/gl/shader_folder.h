// SPDX-License-Identifier: MIT
#pragma once
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

namespace izb::test {

/// A shader folder of its own, which programs are made of while the test runs, and no cache of programs.
struct ShaderFolder : testing::Test {
  const std::filesystem::path folder =
      std::filesystem::path(testing::TempDir()) / ("izb_shader_folder_" + std::to_string(getpid()));

  ShaderFolder() {
    std::filesystem::create_directories(folder);
    setenv("IZB_GLSL", folder.c_str(), 1);
    if (const char* cache = std::getenv("IZB_PROGRAM_CACHE")) outer_cache_ = cache;
    setenv("IZB_PROGRAM_CACHE", "off", 1);
  }
  ~ShaderFolder() override {
    unsetenv("IZB_GLSL");
    if (outer_cache_.empty())
      unsetenv("IZB_PROGRAM_CACHE");
    else
      setenv("IZB_PROGRAM_CACHE", outer_cache_.c_str(), 1);
    std::filesystem::remove_all(folder);
  }
  void write(const std::string& file, const std::string& text) const { std::ofstream(folder / file) << text; }

 private:
  std::string outer_cache_;
};

}  // namespace izb::test
