// SPDX-License-Identifier: MIT
// An option is declared once; the command line, the help, the JSON and any user interface are made from that.
#pragma once
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace CLI {
class App;
}

namespace izb {

/// One declared option. The bound variable holds the value and must outlive every use of the option.
struct Option {
  std::string name;                  ///< without dashes; the switch is `--name`, the JSON key is `name`
  std::string help;                  ///< one line, without unit, range and default
  std::string unit;                  ///< of a number, e.g. "texels"; empty if it has none
  double min = 0.0, max = 0.0;       ///< of a number, inclusive; infinite where there is no limit
  std::vector<std::string> choices;  ///< the accepted words, if only some are
  std::string value_name;            ///< what help shows after the switch, e.g. "FILE"
  nlohmann::json default_value;      ///< the bound variable's value at declaration
  std::variant<bool*, int*, double*, std::string*> value;

  /// Sets the bound variable from the text of a command line or a text field.
  /// Throws izb::UsageError, one sentence that says what is accepted, and leaves the variable as it was.
  void set(const std::string& given) const;

  /// The bound variable's current value.
  nlohmann::json to_json() const;

  /// The help with unit, range and default: "Side of the light grid (texels, 16 to 16384; default 2048)".
  std::string describe() const;
};

/// The options of one command or technique, in order of declaration. Declaring a name twice, or a default
/// that the option itself would refuse, is a bug and throws std::logic_error.
class OptionSet {
 public:
  /// A switch that is given as `--name on` or `--name off`, exactly these words.
  OptionSet& flag(std::string name, bool& value, std::string help);

  /// A whole number in [min, max]. Limits of int itself (INT_MIN, INT_MAX) count as no limit in the texts.
  OptionSet& integer(std::string name, int& value, int min, int max, std::string unit, std::string help);

  /// A number in [min, max], either of which may be infinite; the value itself is always finite.
  OptionSet& number(std::string name, double& value, double min, double max, std::string unit, std::string help);

  /// One of the words in `choices`.
  OptionSet& choice(std::string name, std::string& value, std::vector<std::string> choices, std::string help);

  /// Any text. `value_name` stands for it in the help, e.g. "FILE" or "NAME|INDEX".
  OptionSet& text(std::string name, std::string& value, std::string value_name, std::string help);

  /// Adds `--name VALUE` for each option to a CLI11 application or subcommand, under the help heading
  /// `group`. A wrong value makes parsing throw a CLI::ParseError with one sentence; of a repeated switch the
  /// last counts. The set itself may go away afterwards, the bound variables may not.
  void add_to(CLI::App& app, const std::string& group) const;

  /// One object: the options' current values under their names.
  nlohmann::json to_json() const;

  std::span<const Option> options() const { return options_; }

 private:
  OptionSet& add(Option option);

  std::vector<Option> options_;
};

}  // namespace izb
