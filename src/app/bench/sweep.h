// SPDX-License-Identifier: MIT
// The sweeps of bench/sweeps.json: which jobs an experiment takes.
#pragma once
#include <filesystem>
#include <vector>

#include "app/bench/job.h"

namespace izb::bench {

/// How much of everything: for a look, for a table, all of it.
enum class Extent { quick, full, complete };

/// What the person asks to be otherwise than in the sweeps.
struct SweepRequest {
  std::vector<std::string> experiments;  ///< in the order of the tables; all where empty
  /// Names of procedural scenes, files, folders, names of files in $IZB_SCENES; those of the sweeps where empty.
  std::vector<std::string> scenes;
  std::string size;  ///< empty: that of the sweeps
  int frames = 0;    ///< 0: as many as in the sweeps
  std::string context = "auto";
  Extent extent = Extent::full;
};

/// Reads bench/sweeps.json, or views.json, paper.json beside it, of the source tree or of the installed program. Throws
/// izb::Error if it is missing or not JSON.
nlohmann::json read_bench_data(const std::string& name);

/// The experiments that there are, in the order of the tables.
inline constexpr const char* experiment_names[] = {"table1",    "table2", "figure8",  "figure9", "figure10",
                                                   "ablations", "memory", "temporal", "peers"};

/// The jobs of a request. `sweeps`: bench/sweeps.json; `views`: bench/views.json, whose viewpoints files of the same
/// name get. Files of procedural scenes are named below `folder` and need not exist yet. The word "files" among a
/// sweep's scenes stands for those of the folder in the environment variable IZB_SCENES. Of one experiment no two
/// scenes have the same name. Throws izb::UsageError for an unknown scene and for a folder without any, izb::Error for
/// a folder that cannot be read.
std::vector<Job> plan(const nlohmann::json& sweeps, const nlohmann::json& views, const SweepRequest& request,
                      const std::filesystem::path& folder);

}  // namespace izb::bench
