// SPDX-License-Identifier: MIT
// What a job can measure. Each returns its result as JSON; throws izb::Error where it cannot be had.
#pragma once
#include "app/bench/job.h"

namespace izb::bench {

/// The job's result, whatever it measures: `job`, `made`, `scene`, and what the measure adds. `folder` is where it may
/// leave pictures; their names in the result are relative to it.
nlohmann::json run_job(const Job& job, const std::filesystem::path& folder);

/// The names of all measures.
std::vector<std::string> measure_names();

}  // namespace izb::bench
