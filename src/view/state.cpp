// SPDX-License-Identifier: MIT
#include "view/state.h"

#include <algorithm>

#include "base/error.h"

namespace izb {
namespace {

constexpr const char* compare_names[] = {"off", "split", "flicker", "difference"};

/// As a command line gives it.
std::string text_of(const nlohmann::json& value) {
  if (value.is_boolean()) return value.get<bool>() ? "on" : "off";
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number_integer()) return fmt::format("{}", value.get<int64_t>());
  if (value.is_number()) return fmt::format("{}", value.get<double>());
  fail("a value is neither a word nor a number: {}", value.dump());
}

void set_all(const OptionSet& set, const nlohmann::json& values, const std::string& whose) {
  for (const auto& [key, value] : values.items()) {
    const auto options = set.options();
    const auto option = std::find_if(options.begin(), options.end(), [&](const Option& o) { return o.name == key; });
    if (option == options.end()) throw UsageError(fmt::format("{} has no option '{}'", whose, key));
    option->set(text_of(value));
  }
}

std::string quoted(const std::string& word) {
  constexpr const char* safe = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_./,:=+@%";
  if (!word.empty() && word.find_first_not_of(safe) == std::string::npos) return word;
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

/// Adds `--name value` for each option that is not as `defaults` has it.
void add_changed(std::vector<std::string>& words, const OptionSet& set, const OptionSet& defaults,
                 std::initializer_list<const char*> without = {}) {
  for (size_t i = 0; i < set.options().size(); ++i) {
    const Option& option = set.options()[i];
    if (std::find(without.begin(), without.end(), option.name) != without.end()) continue;
    if (option.to_json() == defaults.options()[i].to_json()) continue;
    words.push_back("--" + option.name);
    words.push_back(text_of(option.to_json()));
  }
}

template <typename T>
void take(const nlohmann::json& json, const char* key, T& value) {
  if (const auto entry = json.find(key); entry != json.end()) value = entry->get<T>();
}

}  // namespace

const char* name(Compare compare) {
  return compare_names[static_cast<size_t>(compare)];
}

SideState SideState::of(const std::string& technique, const std::string& preset) {
  const std::unique_ptr<Technique> made = make_technique(technique);
  if (!preset.empty()) made->apply_preset(preset);
  return {technique, made->options().to_json()};
}

std::unique_ptr<Technique> SideState::make() const {
  std::unique_ptr<Technique> made = make_technique(technique);
  set_all(made->options(), options, fmt::format("technique '{}'", technique));
  return made;
}

nlohmann::json ViewState::to_json() const {
  FrameOptions copy = frame;
  nlohmann::json both = nlohmann::json::array();
  for (const SideState& side : sides) both.push_back({{"technique", side.technique}, {"options", side.options}});
  return {{"scene", scene},
          {"frame", copy.options().to_json()},
          {"sides", both},
          {"active", active},
          {"truth", truth},
          {"compare", name(compare)},
          {"split", split},
          {"look", look},
          {"layer", layer},
          {"active_light", active_light},
          {"lens", lens},
          {"lens_power", lens_power},
          {"frozen", frozen},
          {"frusta", frusta},
          {"picked", picked ? nlohmann::json::array({picked->x, picked->y}) : nlohmann::json()}};
}

ViewState ViewState::from_json(const nlohmann::json& json) {
  ViewState state;
  try {
    if (!json.is_object()) fail("it is not an object");
    take(json, "scene", state.scene);
    if (json.contains("frame")) set_all(state.frame.options(), json["frame"], "a frame");
    if (json.contains("sides")) {
      if (!json["sides"].is_array() || json["sides"].size() != 2) fail("'sides' must be two");
      for (size_t i = 0; i < 2; ++i) {
        const nlohmann::json& side = json["sides"][i];
        state.sides[i] = SideState::of(side.value("technique", std::string("izb")));
        if (side.contains("options")) state.sides[i].options.update(side["options"]);
        state.sides[i].make();
      }
    }
    take(json, "active", state.active);
    take(json, "truth", state.truth);
    take(json, "split", state.split);
    take(json, "look", state.look);
    take(json, "layer", state.layer);
    take(json, "active_light", state.active_light);
    take(json, "lens", state.lens);
    take(json, "lens_power", state.lens_power);
    take(json, "frozen", state.frozen);
    take(json, "frusta", state.frusta);
    if (const auto picked = json.find("picked"); picked != json.end() && !picked->is_null())
      state.picked = {picked->at(0).get<int>(), picked->at(1).get<int>()};
    const std::string compare = json.value("compare", std::string("off"));
    const auto found = std::find(std::begin(compare_names), std::end(compare_names), compare);
    if (found == std::end(compare_names)) fail("'compare' is off, split, flicker or difference, not '{}'", compare);
    state.compare = static_cast<Compare>(found - std::begin(compare_names));
  } catch (const nlohmann::json::exception& e) {
    fail("{}", e.what());
  }
  state.active = std::clamp(state.active, 0, 1);
  state.split = std::clamp(state.split, 0.0, 1.0);
  state.lens_power = std::clamp(state.lens_power, 2, 32);
  state.layer = std::max(state.layer, 0);
  state.active_light = std::max(state.active_light, 0);
  return state;
}

std::vector<std::string> batch_arguments(const ViewState& state, int side, Size size) {
  FrameOptions frame = state.frame, defaults;
  const SideState& its = state.sides[static_cast<size_t>(side)];
  std::vector<std::string> words{"render", state.scene, "--size", fmt::format("{}x{}", size.width_px, size.height_px)};
  if (frame.eye.empty()) frame.fov_deg = defaults.fov_deg;  // it goes with --eye alone
  add_changed(words, frame.options(), defaults.options(), {"size", "technique", "preset", "context"});
  if (its.technique != defaults.technique) words.insert(words.end(), {"--technique", its.technique});
  const std::unique_ptr<Technique> made = its.make(), fresh = make_technique(its.technique);
  add_changed(words, made->options(), fresh->options());
  return words;
}

std::string batch_command(const ViewState& state, int side, Size size) {
  std::string text = "izb";
  for (const std::string& word : batch_arguments(state, side, size)) text += " " + quoted(word);
  return text;
}

}  // namespace izb
