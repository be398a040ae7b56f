// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace izb {

/// The bytes in base 64 (RFC 4648, section 4): padded, without line breaks.
std::string base64(std::span<const std::byte> bytes);
std::string base64(std::string_view text);

}  // namespace izb
