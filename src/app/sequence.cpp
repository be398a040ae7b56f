// SPDX-License-Identifier: MIT
#include "app/sequence.h"

#include <charconv>
#include <filesystem>

#include "base/error.h"
#include "base/file.h"
#include "image/exr.h"

namespace izb {
namespace {

/// What may differ between two runs that render the same pictures.
nlohmann::json without_outputs(nlohmann::json options) {
  for (const char* key : {"preview", "json", "frames", "resume", "repeat", "peer", "supersample", "checkpoint"})
    options.erase(key);
  return options;
}

nlohmann::json stored_facts(const std::string& path) {
  if (path.ends_with(".json")) return nlohmann::json::parse(read_text_file(path));
  const auto attributes = read_exr_attributes(path);
  nlohmann::json facts;
  for (const char* key : {"options", "scene", "frame", "supersample", "exposure"}) {
    const auto it = attributes.find(std::string("izb.") + key);
    if (it == attributes.end() || !std::holds_alternative<std::string>(it->second)) continue;
    facts[key] = nlohmann::json::parse(std::get<std::string>(it->second));
  }
  return facts;
}

}  // namespace

void SequenceOptions::declare(OptionSet& set) {
  set.text("frames", frames, "FIRST:LAST",
           "render the frames with these numbers, both included, each into files of its own: # in a file's name "
           "stands for a digit of the number; without any, .0000 comes before the extension");
  set.number("fps", fps, 0.001, 1e6, "frames a second", "with --frames: frame n shows the moment --time + n / fps");
  set.flag("resume", resume,
           "with --frames: leave out the frames whose files are there already; with --supersample: go on with the "
           "frames that the file of -o holds");
}

std::optional<FrameRange> frame_range(const SequenceOptions& options) {
  const std::string& text = options.frames;
  if (text.empty()) return {};
  FrameRange range;
  const char* const end = text.data() + text.size();
  const auto [after_first, error] = std::from_chars(text.data(), end, range.first);
  range.last = range.first;
  bool good = error == std::errc();
  if (good && after_first != end) {
    const auto [after_last, last_error] = std::from_chars(after_first + 1, end, range.last);
    good = *after_first == ':' && last_error == std::errc() && after_last == end;
  }
  if (!good || range.first < 0 || range.last < range.first)
    throw UsageError(fmt::format("--frames must be FIRST:LAST, two numbers from 0 up in order, not '{}'", text));
  return range;
}

std::string numbered(const std::string& path, int frame) {
  if (path.empty()) return {};
  const std::filesystem::path whole(path);
  const std::string name = whole.filename().string();
  const size_t first = name.find('#');
  std::string result;
  if (first == std::string::npos) {
    result = fmt::format("{}.{:04}{}", whole.stem().string(), frame, whole.extension().string());
  } else {
    const size_t end = std::min(name.find_first_not_of('#', first), name.size());
    result = fmt::format("{}{:0{}}{}", name.substr(0, first), frame, end - first, name.substr(end));
  }
  return (whole.parent_path() / result).string();
}

nlohmann::json rendered_facts(const std::string& path, const nlohmann::json& facts) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) return {};
  nlohmann::json stored;
  try {
    stored = stored_facts(path);
  } catch (const nlohmann::json::exception&) {
  }
  if (!stored.is_object() || !stored.contains("options"))
    fail("'{}' is no frame that izb rendered, so --resume stops", path);
  bool same = without_outputs(stored["options"]) == without_outputs(facts["options"]) &&
              stored.contains("supersample") == facts.contains("supersample");
  for (const char* key : {"scene", "frame"})
    same = same && stored.value(key, nlohmann::json()) == facts.value(key, nlohmann::json());
  if (!same) fail("'{}' was rendered with other options or of another scene, so --resume stops", path);
  return stored;
}

bool is_rendered(const std::string& path, const nlohmann::json& facts) {
  const nlohmann::json stored = rendered_facts(path, facts);
  return !stored.is_null() && stored.value("supersample", 0) == facts.value("supersample", 0);
}

}  // namespace izb
