// SPDX-License-Identifier: MIT
#include "app/attribution.h"

#include <algorithm>
#include <string_view>

#include "frame/read_back.h"

namespace izb {
namespace {

using Twins = reference::MaskTwins;

/// What may be approximate, and the mask without it.
struct Approximation {
  const char* option;
  std::vector<uint32_t> Twins::*exact;
};
constexpr Approximation approximations[] = {
    {"coverage", &Twins::exact_coverage}, {"alpha", &Twins::exact_alpha}, {"insertion", &Twins::exact}};

/// The option's text, or nothing where the technique has no such option.
std::optional<std::string> value_of(const OptionSet& set, const std::string& name) {
  for (const Option& option : set.options())
    if (option.name == name) return option.to_json().get<std::string>();
  return std::nullopt;
}

void set_value(const OptionSet& set, const std::string& name, const std::optional<std::string>& value) {
  for (const Option& option : set.options())
    if (option.name == name && value) option.set(*value);
}

void render_again(Session& session, Technique& technique) {
  session.renderer.prepare(technique, session.frame.size.width_px, session.frame.size.height_px, session.frame.lights);
  session.renderer.render(session.frame.camera, session.frame.lights, session.timers);
  session.timers.collect();
}

/// Whether this option of the technique makes bits of the session's frame other than exact.
bool is_asked(const Approximation& approximation, const Session& session, Technique& technique) {
  const bool matters = std::string_view(approximation.option) == "alpha"
                           ? session.renderer.inputs().masked_casters
                           : technique.samples().count() == samples_a_word;
  return matters && value_of(technique.options(), approximation.option).value_or("exact") != "exact";
}

}  // namespace

bool approximates(Session& session, Technique& technique) {
  return std::any_of(std::begin(approximations), std::end(approximations),
                     [&](const Approximation& a) { return is_asked(a, session, technique); });
}

std::vector<reference::MaskTwins> render_twins(Session& session, Technique& technique) {
  const OptionSet set = technique.options();
  std::vector<Twins> twins(session.renderer.light_count());
  const auto keep = [&](std::vector<uint32_t> Twins::*mask) {
    for (size_t i = 0; i < twins.size(); ++i) twins[i].*mask = session.renderer.read_mask(i);
  };
  keep(&Twins::asked);
  std::vector<std::optional<std::string>> asked;
  for (const Approximation& a : approximations) {
    asked.push_back(value_of(set, a.option));
    if (is_asked(a, session, technique)) {
      set_value(set, a.option, "exact");
      render_again(session, technique);
    }
    keep(a.exact);
  }
  for (size_t i = 0; i < asked.size(); ++i) set_value(set, approximations[i].option, asked[i]);
  render_again(session, technique);
  return twins;
}

}  // namespace izb
