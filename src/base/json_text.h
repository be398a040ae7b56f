// SPDX-License-Identifier: MIT
// JSON as text: the only way that this program writes it.
#pragma once
#include <nlohmann/json.hpp>
#include <string>

namespace izb {

/// The text of `json`; `indent` as nlohmann's. Bytes that are not UTF-8, which paths and names may hold, become U+FFFD:
/// by default they throw.
inline std::string json_text(const nlohmann::json& json, int indent = -1) {
  return json.dump(indent, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace izb
