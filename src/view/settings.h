// SPDX-License-Identifier: MIT
// What the viewer remembers from start to start: nothing but what a person dismissed for good.
#pragma once
#include <filesystem>
#include <string>

namespace izb {

struct ViewSettings {
  bool hints = true;  ///< shown at the start
};

/// izb/view.json in $XDG_CONFIG_HOME, or in ~/.config (XDG Base Directory Specification); empty without a home.
std::filesystem::path default_settings_file();

/// Defaults where there is no such file. Throws izb::Error if there is one that cannot be read.
ViewSettings read_settings(const std::filesystem::path& file);

/// Makes the folder if it must. Throws izb::Error if that or the file cannot be written.
void write_settings(const std::filesystem::path& file, const ViewSettings& settings);

/// FOLDER/STEM-0001.EXTENSION, the first number of which no file FOLDER/STEM-0001.* stands there.
std::filesystem::path next_file(const std::filesystem::path& folder, const std::string& stem,
                                const std::string& extension);

}  // namespace izb
