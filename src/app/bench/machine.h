// SPDX-License-Identifier: MIT
// On what something was measured: numbers without it mean nothing.
#pragma once
#include <nlohmann/json.hpp>

#include "app/gl_setup.h"

namespace izb::bench {

/// `processor`, `cores`, `memory_bytes`, `system`; null where the system does not say.
nlohmann::json machine_json();

/// `version`, `date` (UTC), `machine`, `gl` (context, vendor, renderer, version), `software` (whether GL runs on the
/// CPU), `timing` (`wall` or `query`), `embree`.
nlohmann::json made_json(const Gl& gl);

/// Whether two results were measured by the same commit on the same machine with the same driver.
bool same_conditions(const nlohmann::json& made, const nlohmann::json& other);

}  // namespace izb::bench
