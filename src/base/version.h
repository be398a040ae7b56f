// SPDX-License-Identifier: MIT
#pragma once
#include <string_view>

namespace izb {

/// The program's version, e.g. "0.1.0".
std::string_view version();

/// The git commit that the build was configured from, abbreviated; "unknown" outside a git repository.
std::string_view commit();

}  // namespace izb
