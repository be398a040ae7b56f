// SPDX-License-Identifier: MIT
// The files that the report's page is made of.
#pragma once
#include <filesystem>
#include <string>

namespace izb::report {

/// The folder of the page's styles and scripts: $IZB_REPORT, beside the installed program, or the source tree. Throws
/// izb::Error if it is nowhere.
std::filesystem::path assets_folder();

struct Assets {
  std::string styles;   ///< CSS
  std::string theme;    ///< JavaScript that runs before the page is shown
  std::string scripts;  ///< JavaScript that runs once the page is there
  std::string d3;       ///< the library, with its first line that names it; empty: this build has none
  std::string d3_licence;
};

/// Throws izb::Error if a file but d3 is missing.
Assets read_assets();

}  // namespace izb::report
