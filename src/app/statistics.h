// SPDX-License-Identifier: MIT
// What a frame cost in numbers that do not depend on the machine, as in the paper's table 1 and its supplement.
#pragma once
#include <nlohmann/json.hpp>

#include "app/rendered_frame.h"

namespace izb {

/// Adds to the JSON of a frame, which has its `lights`: `counts`, `averages` and, where the technique has lists,
/// `list_histogram`, of the last frame, by a frame of its own. They are sums over the lights; of several lights each
/// has its own counts and averages, too.
/// Without `unculled` what a frame without culling would do is left out.
void add_statistics(nlohmann::json& json, const RenderedFrame& rendered, bool unculled = true);

}  // namespace izb
