// SPDX-License-Identifier: MIT
#include "app/bench/machine.h"

#include <sys/utsname.h>
#include <unistd.h>

#include <ctime>
#include <fstream>
#include <thread>

#include "app/results.h"
#include "base/error.h"
#include "reference/embree.h"

namespace izb::bench {
namespace {

/// What follows `key` and `separator` in the first such line of a file; empty if there is none.
std::string value_in(const char* file, const std::string& key, char separator) {
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    if (!line.starts_with(key)) continue;
    const size_t at = line.find(separator);
    if (at == std::string::npos) continue;
    std::string value = line.substr(at + 1);
    std::erase(value, '"');
    value.erase(0, value.find_first_not_of(" \t"));
    return value;
  }
  return {};
}

nlohmann::json text_or_null(const std::string& text) {
  return text.empty() ? nlohmann::json() : nlohmann::json(text);
}

std::string system_name() {
  utsname name{};
  std::string kernel;
  if (uname(&name) == 0) kernel = fmt::format("{} {} ({})", name.sysname, name.release, name.machine);
  const std::string distribution = value_in("/etc/os-release", "PRETTY_NAME", '=');
  return distribution.empty() ? kernel : distribution + ", " + kernel;
}

std::string utc_now() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc);
  return text;
}

}  // namespace

nlohmann::json machine_json() {
  nlohmann::json facts{{"processor", text_or_null(value_in("/proc/cpuinfo", "model name", ':'))},
                       {"cores", std::thread::hardware_concurrency()},
                       {"memory_bytes", nullptr},
                       {"system", text_or_null(system_name())}};
  const long pages = sysconf(_SC_PHYS_PAGES), page_bytes = sysconf(_SC_PAGE_SIZE);
  if (pages > 0 && page_bytes > 0) facts["memory_bytes"] = uint64_t(pages) * uint64_t(page_bytes);
  return facts;
}

nlohmann::json made_json(const Gl& gl) {
  nlohmann::json facts{{"version", origin_json({})["version"]},
                       {"date", utc_now()},
                       {"machine", machine_json()},
                       {"gl",
                        {{"context", gl.context.name},
                         {"vendor", gl.capabilities.vendor},
                         {"renderer", gl.capabilities.renderer},
                         {"version", gl.capabilities.version}}},
                       {"software", gl.capabilities.software},
                       {"timing", gl.capabilities.software ? "wall" : "query"},
                       {"embree", reference::embree_version()}};
  return facts;
}

bool same_conditions(const nlohmann::json& made, const nlohmann::json& other) {
  if (!made.is_object() || !other.is_object()) return false;
  for (const char* key : {"version", "machine", "gl", "software", "embree"})
    if (made.value(key, nlohmann::json()) != other.value(key, nlohmann::json())) return false;
  return true;
}

}  // namespace izb::bench
