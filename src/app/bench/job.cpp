// SPDX-License-Identifier: MIT
#include "app/bench/job.h"

#include <algorithm>
#include <cctype>
#include <span>

#include "base/error.h"
#include "base/sha256.h"

namespace izb::bench {

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(BenchScene, name, file, procedural, triangles, sha256, frame)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Configuration, name, technique, preset, size, options, notes)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Job, experiment, part, measure, scene, size, context, frames, configurations,
                                   settings)

namespace {

void set_option(const OptionSet& set, const std::string& name, const std::string& value) {
  const auto options = set.options();
  const auto it = std::find_if(options.begin(), options.end(), [&](const Option& o) { return o.name == name; });
  if (it == options.end()) throw UsageError(fmt::format("there is no option --{}", name));
  it->set(value);
}

}  // namespace

std::string Configuration::command_line() const {
  std::string text = "--technique " + technique;
  if (!preset.empty()) text += " --preset " + preset;
  for (const auto& [option, value] : options) text += " --" + option + " " + value;
  return text;
}

nlohmann::json to_json(const Job& job) {
  return job;
}

Job job_from(const nlohmann::json& text) {
  return text.get<Job>();
}

bool same_work(Job a, Job b) {
  a.scene.file.clear(), b.scene.file.clear();
  return to_json(a) == to_json(b);
}

std::string file_word(const std::string& name) {
  constexpr size_t most = 100;  // of the 255 bytes that file systems allow
  const auto stays = [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '-' || c >= 0x80; };
  std::string word = name.substr(0, most);
  if (name.size() > most)
    word.erase(std::find_if(word.begin(), word.end(), [](unsigned char c) { return c >= 0x80; }), word.end());
  std::replace_if(
      word.begin(), word.end(), [&](char c) { return !stays(static_cast<unsigned char>(c)); }, '_');
  if (word != name || name.empty()) word += "-" + sha256_hex(std::as_bytes(std::span(name))).substr(0, 8);
  return word;
}

FrameOptions frame_options(const Job& job) {
  FrameOptions options;
  const OptionSet set = options.options(false);
  for (const auto& [name, value] : job.scene.frame) set_option(set, name, value);
  set_option(set, "size", job.size);
  set_option(set, "context", job.context);
  return options;
}

std::unique_ptr<Technique> make_technique(const Configuration& configuration) {
  std::unique_ptr<Technique> technique = izb::make_technique(configuration.technique);
  if (!configuration.preset.empty()) technique->apply_preset(configuration.preset);
  const OptionSet set = technique->options();
  for (const auto& [name, value] : configuration.options) set_option(set, name, value);
  return technique;
}

}  // namespace izb::bench
