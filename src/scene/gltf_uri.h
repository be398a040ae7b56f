// SPDX-License-Identifier: MIT
#pragma once
#include <string>
#include <string_view>

namespace izb {

/// A relative URI of a glTF file as a path: "%20" is a space. What is no such code stays.
std::string percent_decoded(std::string_view uri);

}  // namespace izb
