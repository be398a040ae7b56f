// SPDX-License-Identifier: MIT
#include "base/options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "base/error.h"

namespace izb {
namespace {

/// "16 to 16384", "at least 0", "at most 90", or nothing.
std::string range_text(const Option& option) {
  if (option.value.index() == 0 || option.value.index() == 3) return {};
  const bool below = std::isfinite(option.min), above = std::isfinite(option.max);
  if (below && above) return fmt::format("{} to {}", option.min, option.max);
  if (below) return fmt::format("at least {}", option.min);
  if (above) return fmt::format("at most {}", option.max);
  return {};
}

/// Reads all of `given` as a T; false if it is anything else.
template <typename T>
bool parse(const std::string& given, T& value) {
  const char* end = given.data() + given.size();
  const auto [stop, error] = std::from_chars(given.data(), end, value);
  return error == std::errc() && stop == end;
}

[[noreturn]] void refuse(const Option& option, const std::string& accepted, const std::string& given) {
  throw UsageError(fmt::format("--{} must be {}, not '{}'", option.name, accepted, given));
}

template <typename T>
T parse_number(const Option& option, const char* kind, const std::string& given) {
  T value{};
  if (parse(given, value) && std::isfinite(double(value)) && value >= option.min && value <= option.max) {
    return value;
  }
  std::string accepted = kind;
  const std::string range = range_text(option);
  if (!range.empty()) accepted += (std::isfinite(option.min) && std::isfinite(option.max) ? " from " : " of ") + range;
  if (!option.unit.empty()) accepted += fmt::format(" ({})", option.unit);
  refuse(option, accepted, given);
}

std::string default_text(const Option& option) {
  const nlohmann::json& value = option.default_value;
  if (value.is_boolean()) return value.get<bool>() ? "on" : "off";
  if (value.is_string()) return value.get<std::string>();
  return value.is_number_integer() ? fmt::format("{}", value.get<int>()) : fmt::format("{}", value.get<double>());
}

}  // namespace

void Option::set(const std::string& given) const {
  if (!choices.empty() && std::find(choices.begin(), choices.end(), given) == choices.end()) {
    refuse(*this, fmt::format("{}", fmt::join(choices, " or ")), given);
  }
  if (bool* const* flag = std::get_if<bool*>(&value)) {
    **flag = given == "on";
  } else if (int* const* integer = std::get_if<int*>(&value)) {
    **integer = parse_number<int>(*this, "a whole number", given);
  } else if (double* const* number = std::get_if<double*>(&value)) {
    **number = parse_number<double>(*this, "a number", given);
  } else {
    *std::get<std::string*>(value) = given;
  }
}

nlohmann::json Option::to_json() const {
  return std::visit([](const auto* bound) { return nlohmann::json(*bound); }, value);
}

std::string Option::describe() const {
  std::vector<std::string> facts;
  if (!unit.empty()) facts.push_back(unit);
  if (const std::string range = range_text(*this); !range.empty()) facts.push_back(range);
  std::string text = fmt::format("{}", fmt::join(facts, ", "));
  if (const std::string preset = default_text(*this); !preset.empty()) {
    text += (text.empty() ? "default " : "; default ") + preset;
  }
  return text.empty() ? help : fmt::format("{} ({})", help, text);
}

OptionSet& OptionSet::add(Option option) {
  for (const Option& other : options_) {
    if (other.name == option.name) throw std::logic_error("option declared twice: " + option.name);
  }
  option.default_value = option.to_json();
  try {
    option.set(default_text(option));
  } catch (const UsageError& error) {
    throw std::logic_error(fmt::format("default of option refused: {}", error.what()));
  }
  options_.push_back(std::move(option));
  return *this;
}

OptionSet& OptionSet::flag(std::string name, bool& value, std::string help) {
  Option option;
  option.name = std::move(name), option.help = std::move(help);
  option.choices = {"on", "off"}, option.value_name = "on|off";
  option.value = &value;
  return add(std::move(option));
}

OptionSet& OptionSet::integer(std::string name, int& value, int min, int max, std::string unit, std::string help) {
  constexpr double unlimited = std::numeric_limits<double>::infinity();
  Option option;
  option.name = std::move(name), option.help = std::move(help), option.unit = std::move(unit);
  option.min = min == std::numeric_limits<int>::min() ? -unlimited : min;
  option.max = max == std::numeric_limits<int>::max() ? unlimited : max;
  option.value_name = "N";
  option.value = &value;
  return add(std::move(option));
}

OptionSet& OptionSet::number(std::string name, double& value, double min, double max, std::string unit,
                             std::string help) {
  Option option;
  option.name = std::move(name), option.help = std::move(help), option.unit = std::move(unit);
  option.min = min, option.max = max;
  option.value_name = "X";
  option.value = &value;
  return add(std::move(option));
}

OptionSet& OptionSet::choice(std::string name, std::string& value, std::vector<std::string> choices, std::string help) {
  Option option;
  option.name = std::move(name), option.help = std::move(help);
  option.value_name = fmt::format("{}", fmt::join(choices, "|"));
  option.choices = std::move(choices);
  option.value = &value;
  return add(std::move(option));
}

OptionSet& OptionSet::text(std::string name, std::string& value, std::string value_name, std::string help) {
  Option option;
  option.name = std::move(name), option.help = std::move(help);
  option.value_name = std::move(value_name);
  option.value = &value;
  return add(std::move(option));
}

void OptionSet::add_to(CLI::App& app, const std::string& group) const {
  for (const Option& option : options_) {
    const CLI::callback_t parse_value = [option](const CLI::results_t& given) {
      try {
        option.set(given.back());
      } catch (const UsageError& error) {
        throw CLI::ValidationError(std::string(error.what()));
      }
      return true;
    };
    app.add_option("--" + option.name, parse_value, option.describe())
        ->type_name(option.value_name)
        ->group(group)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
  }
}

nlohmann::json OptionSet::to_json() const {
  nlohmann::json values = nlohmann::json::object();
  for (const Option& option : options_) values[option.name] = option.to_json();
  return values;
}

}  // namespace izb
