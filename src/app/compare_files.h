// SPDX-License-Identifier: MIT
// Two image files, channel by channel.
#pragma once
#include <string>

#include "app/comparison.h"
#include "image/flip.h"

namespace izb {

struct CompareFilesOptions {
  std::string channels = "auto";
  double exposure_stops = 0.0;
  double pixels_per_degree = default_pixels_per_degree;
};

/// Compares the file `test` with the file `reference`, each OpenEXR or PNG. R, G and B together are colour, channels of
/// unsigned integers named `mask` or `mask.NAME` are masks, all others are values. Masks are compared where the
/// reference's channel `depth`, if it has one, is above 0. Throws izb::Error if a file cannot be read, the sizes
/// differ, the chosen channels are not the same in both or have other types, or a value is not finite; izb::UsageError
/// for an exposure of code values.
Comparison compare_files(const std::string& reference, const std::string& test, const CompareFilesOptions& options);

}  // namespace izb
