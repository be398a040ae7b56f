// SPDX-License-Identifier: MIT
// What a frame cost in numbers that do not depend on the machine, as in the paper's table 1 and its supplement.
#pragma once
#include <nlohmann/json.hpp>

#include "app/session.h"

namespace izb {

/// `counts`, `averages` and, where the technique has lists, `list_histogram`, of the last frame, by a frame of its own.
nlohmann::json statistics_json(Session& session);

}  // namespace izb
