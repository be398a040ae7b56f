// SPDX-License-Identifier: MIT
#include "app/attribution.h"

#include <algorithm>

#include "frame/read_back.h"

namespace izb {
namespace {

constexpr const char* approximations[] = {"coverage", "insertion"};

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

}  // namespace

bool approximates(Technique& technique) {
  if (technique.samples().count() != samples_a_word) return false;
  const OptionSet set = technique.options();
  return std::any_of(std::begin(approximations), std::end(approximations),
                     [&](const char* name) { return value_of(set, name).value_or("exact") != "exact"; });
}

std::vector<reference::MaskTwins> render_twins(Session& session, Technique& technique) {
  const OptionSet set = technique.options();
  std::vector<std::optional<std::string>> asked;
  for (const char* name : approximations) asked.push_back(value_of(set, name));
  std::vector<reference::MaskTwins> twins(session.renderer.light_count());
  const auto keep = [&](std::vector<uint32_t> reference::MaskTwins::*mask) {
    for (size_t i = 0; i < twins.size(); ++i) twins[i].*mask = session.renderer.read_mask(i);
  };
  keep(&reference::MaskTwins::asked);
  set_value(set, approximations[0], "exact");
  render_again(session, technique);
  keep(&reference::MaskTwins::exact_coverage);
  set_value(set, approximations[1], "exact");
  render_again(session, technique);
  keep(&reference::MaskTwins::exact);
  for (size_t i = 0; i < asked.size(); ++i) set_value(set, approximations[i], asked[i]);
  render_again(session, technique);
  return twins;
}

}  // namespace izb
