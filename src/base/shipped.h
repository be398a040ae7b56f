// SPDX-License-Identifier: MIT
// What comes with the program: shaders, styles, sweeps, views.
#pragma once
#include <filesystem>
#include <string>

namespace izb {

/// A file or folder that comes with the program: `installed` below share/izb beside it, or else `source` below the tree
/// that it was built from, since a program may be installed below a source tree, too. Throws izb::Error if it is in
/// neither; `hint` then says what to do.
std::filesystem::path shipped_path(const std::string& installed, const std::string& source,
                                   const std::string& hint = "install the program again");

}  // namespace izb
