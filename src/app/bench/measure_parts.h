// SPDX-License-Identifier: MIT
// The measures of run_job(), one file each.
#pragma once
#include <filesystem>

#include "app/bench/subjects.h"

namespace izb::bench {

/// `configurations` as Subjects::results() has them: `job.frames` rounds after one unmeasured. With the setting `peer`
/// also Embree on the frame of the first configuration that works, in the same rounds: `peer`. With `pictures` also
/// that configuration's picture and heat maps: `pictures`, as make_report() takes images.
void measure_times(const Job& job, Subjects& subjects, const std::filesystem::path& folder, nlohmann::json& result);

/// The same over an animation: round n stands n / `fps` seconds after `first_s` (both settings), so that sample n of
/// each list is that frame's. Counts are of the last frame. Of a scene that does not move every configuration fails.
void measure_animation(const Job& job, Subjects& subjects, const std::filesystem::path& folder, nlohmann::json& result);

/// Times, and of each configuration `speed_of_light` (tests, ms, same_mask; table 2), or `speed_of_light_failed`.
void measure_speed_of_light(const Job& job, Subjects& subjects, const std::filesystem::path& folder,
                            nlohmann::json& result);

/// Times, and of each configuration `beams`: what a beam tracer tests for the same receivers (figure 10).
void measure_beams(const Job& job, Subjects& subjects, const std::filesystem::path& folder, nlohmann::json& result);

/// Over `job.frames` steps, of the camera by `step_px` pixels or of the light by `step_deg` degrees (settings), of each
/// configuration `temporal`: flips (pixels that go from mostly lit to mostly not or back), the mean change of the share
/// of light, and how far that is from the change in truth, which is the first configuration. At least two steps.
void measure_temporal(const Job& job, Subjects& subjects, const std::filesystem::path& folder, nlohmann::json& result);

/// Times, and of each configuration `error` (of the share of light against read_truth(), over `all` pixels with a
/// surface, the `inner` ones, whose every ray meets what could be lit, and of these the flat_pixels()), `flip_mean` of
/// the pictures, and `against_rays` where samples stand at the same points as those of the role `rays`: bits that
/// differ from its.
void measure_quality(const Job& job, Subjects& subjects, const std::filesystem::path& folder, nlohmann::json& result);

}  // namespace izb::bench
