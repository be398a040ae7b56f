// SPDX-License-Identifier: MIT
// Runs the jobs of a plan, each in a process of its own, and keeps their results below a folder.
#pragma once
#include <filesystem>
#include <functional>

#include "app/bench/job.h"

namespace izb::bench {

/// A job and what came of it: `result` is what run_job() returned; or `job`, `failed` (one sentence), `made`; null: not
/// run.
struct Measured {
  Job job;
  nlohmann::json result;

  bool works() const { return result.is_object() && !result.contains("failed"); }
  /// Why there is no result.
  std::string reason() const;
  /// Configurations of a result of which something could not be measured.
  size_t failed_configurations() const;
};

struct RunOptions {
  std::filesystem::path folder;
  bool resume = false;
  bool alone = false;            ///< nobody else writes to the folder: what is half written there is left over
  double time_limit_s = 1800.0;  ///< a job
};

/// Where a job's result is: FOLDER/runs/EXPERIMENT/[PART.]SCENE[.CONFIGURATION].json.
std::filesystem::path result_path(const Job& job, const std::filesystem::path& folder);

/// Runs those jobs whose results are not there. A result counts as there if it is of the same work, was measured
/// under the conditions `made` (see same_conditions()), and has its pictures; what failed is run again. `after` each
/// job is given all. Ends early, with what there is, when the process is asked to end. Throws izb::Error where a result
/// cannot be written.
std::vector<Measured> run_jobs(const std::vector<Job>& jobs, const RunOptions& options, const nlohmann::json& made,
                               const std::function<void(const std::vector<Measured>&)>& after);

}  // namespace izb::bench
