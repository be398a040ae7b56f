// SPDX-License-Identifier: MIT
// What `izb compare` found, whatever it compared.
#pragma once
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "image/image.h"
#include "image/mask_metrics.h"

namespace izb {

/// `json` has up to three arrays of objects, each with a `name`: `color`, `masks` and `values`.
struct Comparison {
  nlohmann::json json;
  Image errors;                  ///< the error of each pixel, a channel for each thing compared
  std::vector<Image8> pictures;  ///< the same to look at

  int width_px() const { return errors.width_px; }
  int height_px() const { return errors.height_px; }
};

/// The most, or the least, that one number of a comparison may be.
struct Limit {
  const char* option;
  const char* group;   ///< of the comparison's JSON
  const char* key;     ///< in each object of the group
  double value, none;  ///< where they are equal, there is no limit
  bool is_least = false;

  bool is_set() const { return value != none; }
};

/// An object of `masks`: counts, percentages and coverage errors of one mask.
nlohmann::json mask_json(const std::string& name, const MaskDifference& difference);

/// Adds a channel of the pixels' coverage errors, `coverage_error` and what follows `mask` in the mask's name; 0 where
/// `counted`, if it is not empty, is 0.
void add_coverage_errors(Image& errors, const std::string& mask_name, std::span<const uint32_t> reference,
                         std::span<const uint32_t> test, int spp, std::span<const uint8_t> counted);

/// The options whose limits are broken, each said on stderr. Throws izb::UsageError, having said nothing, for a limit
/// of what was not compared: a check that checks nothing must not pass.
std::vector<std::string> broken_limits(const Comparison& comparison, std::span<const Limit> limits);

/// One table for each group that is there.
void print_tables(const Comparison& comparison);

}  // namespace izb
