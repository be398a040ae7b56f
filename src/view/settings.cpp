// SPDX-License-Identifier: MIT
#include "view/settings.h"

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/file.h"

namespace izb {
namespace fs = std::filesystem;

fs::path default_settings_file() {
  const char* const config = std::getenv("XDG_CONFIG_HOME");
  if (config && fs::path(config).is_absolute()) return fs::path(config) / "izb/view.json";  // others are to be ignored
  const char* const home = std::getenv("HOME");
  return home && *home ? fs::path(home) / ".config/izb/view.json" : fs::path();
}

ViewSettings read_settings(const fs::path& file) {
  ViewSettings settings;
  std::error_code ignored;
  if (file.empty() || !fs::exists(file, ignored)) return settings;
  try {
    settings.hints = nlohmann::json::parse(read_text_file(file)).value("hints", true);
  } catch (const nlohmann::json::exception& e) {
    fail("cannot read the settings '{}': {}", file.string(), e.what());
  }
  return settings;
}

void write_settings(const fs::path& file, const ViewSettings& settings) {
  if (file.empty()) fail("there is no folder for settings: neither $XDG_CONFIG_HOME nor $HOME is set");
  std::error_code error;
  fs::create_directories(file.parent_path(), error);
  if (error) fail("cannot make the folder '{}': {}", file.parent_path().string(), error.message());
  write_file_atomically(file, nlohmann::json{{"hints", settings.hints}}.dump(1) + "\n");
}

fs::path next_file(const fs::path& folder, const std::string& stem, const std::string& extension) {
  for (int n = 1;; ++n) {
    const std::string name = fmt::format("{}-{:04}", stem, n);
    bool taken = false;
    for (const char* any : {".png", ".exr", ".json", ".csv"}) {
      std::error_code ignored;
      taken = taken || fs::exists(folder / (name + any), ignored);
    }
    if (!taken) return folder / (name + extension);
  }
}

}  // namespace izb
