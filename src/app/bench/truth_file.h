// SPDX-License-Identifier: MIT
// The supersampled truth of a job's frame: a file that `izb render --supersample` makes, in a process of its own.
#pragma once
#include <filesystem>

#include "app/bench/job.h"

namespace izb::bench {

/// Rays a pixel that the job's truth takes, a multiple of 16; 0: it needs none.
int truth_rays(const Job& job);
/// Where it is below `folder`.
std::filesystem::path truth_path(const Job& job, const std::filesystem::path& folder);
/// The program's arguments that make it, or go on making it.
std::vector<std::string> truth_command(const Job& job, const std::filesystem::path& folder);

/// Top row first.
struct Truth {
  int width_px = 0, height_px = 0, rays = 0;
  std::vector<float> surface, receiver, lit;  ///< shares of the rays, see supersample.h
  std::vector<float> rgb[3];                  ///< linear light
};
/// Throws izb::Error if the file is missing or is not what the job needs: one of several lights has no one answer.
Truth read_truth(const Job& job, const std::filesystem::path& folder);

}  // namespace izb::bench
