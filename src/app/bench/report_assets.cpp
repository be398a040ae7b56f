// SPDX-License-Identifier: MIT
#include "app/bench/report_assets.h"

#include <cstdlib>
#include <system_error>

#include "base/file.h"
#include "base/shipped.h"

namespace izb::report {
namespace {

/// d3.min.js beside the other files, or of the source tree where CMake found it; empty: nowhere.
std::filesystem::path find_d3(const std::filesystem::path& folder) {
  std::error_code ignored;
  if (std::filesystem::exists(folder / "d3.min.js", ignored)) return folder / "d3.min.js";
  if (folder == IZB_REPORT_SOURCE_DIR && std::filesystem::exists(IZB_D3, ignored)) return IZB_D3;
  return {};
}

}  // namespace

std::filesystem::path assets_folder() {
  if (const char* folder = std::getenv("IZB_REPORT")) return folder;
  return shipped_path("report", "assets/report", "set IZB_REPORT to the folder of the report's files");
}

Assets read_assets() {
  const std::filesystem::path folder = assets_folder();
  Assets assets;
  assets.styles = read_text_file(folder / "report.css");
  assets.theme = read_text_file(folder / "theme.js");
  for (const char* file :
       {"page.js", "gestures.js", "tables.js", "images.js", "plot_line.js", "plot_bars.js", "plot_svg.js", "plots.js"})
    assets.scripts += read_text_file(folder / file);
  if (const auto d3 = find_d3(folder); !d3.empty()) {
    assets.d3 = read_text_file(d3);
    assets.d3_licence = read_text_file(folder / "d3_licence.txt");
  }
  return assets;
}

}  // namespace izb::report
