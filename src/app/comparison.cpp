// SPDX-License-Identifier: MIT
#include "app/comparison.h"

#include <cmath>
#include <limits>
#include <optional>
#include <string_view>

#include "base/error.h"
#include "base/json_text.h"
#include "base/log.h"
#include "base/table.h"

namespace izb {
namespace {

struct ShownNumber {
  const char* heading;
  const char* key;
};

struct ShownGroup {
  const char* name;
  const char* first_heading;
  std::vector<ShownNumber> numbers;
};

const ShownGroup shown_groups[] = {
    {"color",
     "color",
     {{"RMSE", "rmse"},
      {"PSNR (dB)", "psnr_db"},
      {"SSIM", "ssim"},
      {"FLIP mean", "flip_mean"},
      {"FLIP weighted median", "flip_weighted_median"},
      {"FLIP max", "flip_max"}}},
    {"masks",
     "mask",
     {{"spp", "spp"},
      {"pixels", "pixels"},
      {"bits", "bits"},
      {"differing", "differing"},
      {"%", "differing_percent"},
      {"leaks", "leaks"},
      {"% of shadow", "leak_percent"},
      {"false shadow", "false_shadow"},
      {"% of light", "false_shadow_percent"},
      {"explained", "explained"},
      {"by alpha", "explained_by_alpha"},
      {"unexplained", "unexplained"},
      {"mean coverage error", "mean_coverage_error"},
      {"largest", "largest_coverage_error"}}},
    {"values",
     "channel",
     {{"RMSE", "rmse"}, {"mean difference", "mean_difference"}, {"largest difference", "largest_difference"}}}};

/// JSON has no infinity: of all numbers only the PSNR of equal images is infinite.
constexpr std::string_view infinite_if_null = "psnr_db";

/// Nothing where the object does not have it, or it is not defined.
std::optional<double> number_of(const nlohmann::json& object, const std::string& key) {
  if (!object.contains(key)) return std::nullopt;
  if (!object[key].is_null()) return object[key].get<double>();
  return key == infinite_if_null ? std::optional(std::numeric_limits<double>::infinity()) : std::nullopt;
}

std::string cell_text(const nlohmann::json& object, const std::string& key) {
  const std::optional<double> value = number_of(object, key);
  if (!value) return {};
  if (std::isinf(*value)) return "infinite";
  return object[key].is_number_float() ? fmt::format("{:.6f}", *value) : json_text(object[key]);
}

double percent(uint64_t part, uint64_t whole) {
  return whole ? 100.0 * double(part) / double(whole) : 0.0;
}

}  // namespace

nlohmann::json mask_json(const std::string& name, const MaskDifference& d) {
  return {{"name", name},
          {"spp", d.spp},
          {"pixels", d.pixels},
          {"differing_pixels", d.differing_pixels},
          {"bits", d.bits},
          {"lit", d.lit()},
          {"shadowed", d.shadowed},
          {"differing", d.differing()},
          {"leaks", d.leaks},
          {"false_shadow", d.false_shadow},
          {"differing_percent", percent(d.differing(), d.bits)},
          {"leak_percent", percent(d.leaks, d.shadowed)},
          {"false_shadow_percent", percent(d.false_shadow, d.lit())},
          {"mean_coverage_error", d.mean_coverage_error()},
          {"largest_coverage_error", d.largest_coverage_error}};
}

void add_coverage_errors(Image& errors, const std::string& mask_name, std::span<const uint32_t> reference,
                         std::span<const uint32_t> test, int spp, std::span<const uint8_t> counted) {
  std::vector<float>& values = errors.add_float("coverage_error" + mask_name.substr(std::string_view("mask").size()));
  for (size_t i = 0; i < values.size(); ++i)
    if (counted.empty() || counted[i]) values[i] = coverage_error(reference[i], test[i], spp);
}

std::vector<std::string> broken_limits(const Comparison& comparison, std::span<const Limit> limits) {
  std::vector<std::string> broken;
  std::vector<std::string> sentences;
  for (const Limit& limit : limits) {
    if (!limit.is_set()) continue;
    bool checked = false, holds = true;
    for (const nlohmann::json& object : comparison.json.value(limit.group, nlohmann::json::array())) {
      const std::optional<double> value = number_of(object, limit.key);
      if (!value) continue;
      checked = true;
      if (limit.is_least ? *value >= limit.value : *value <= limit.value) continue;
      holds = false;
      sentences.push_back(fmt::format("{}: {} is {:.9g}, {} --{} {}", object["name"].get<std::string>(), limit.key,
                                      *value, limit.is_least ? "below" : "above", limit.option, limit.value));
    }
    if (!checked)
      throw UsageError(
          fmt::format("--{} cannot be checked: this comparison has no {} of {}", limit.option, limit.key, limit.group));
    if (!holds) broken.push_back(limit.option);
  }
  for (const std::string& sentence : sentences) warn("{}", sentence);
  return broken;
}

void print_tables(const Comparison& comparison) {
  const char* gap = "";
  for (const ShownGroup& group : shown_groups) {
    if (!comparison.json.contains(group.name)) continue;
    const nlohmann::json& objects = comparison.json[group.name];
    std::vector<Column> columns{{group.first_heading, Align::left}};
    std::vector<ShownNumber> numbers;
    for (const ShownNumber& number : group.numbers)
      if (objects[0].contains(number.key)) numbers.push_back(number), columns.push_back({number.heading});
    Table table(columns);
    for (const nlohmann::json& object : objects) {
      std::vector<std::string> row{object["name"].get<std::string>()};
      for (const ShownNumber& number : numbers) row.push_back(cell_text(object, number.key));
      table.add_row(row);
    }
    fmt::print("{}{}", gap, table.str());
    gap = "\n";
  }
}

}  // namespace izb
