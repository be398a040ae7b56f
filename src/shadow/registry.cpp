// SPDX-License-Identifier: MIT
// One line a room.
#include "base/error.h"
#include "shadow/izb/izb.h"
#include "shadow/ray_traced/ray_traced.h"
#include "shadow/shadow_map/shadow_map.h"
#include "shadow/technique.h"

namespace izb {
namespace {

struct Room {
  const char* name;
  std::unique_ptr<Technique> (*make)();
};

constexpr Room rooms[] = {
    {"izb", make_izb},
    {"ray_traced", make_ray_traced},
    {"shadow_map", make_shadow_map},
};

}  // namespace

void Technique::apply_preset(const std::string& name) {
  throw UsageError(fmt::format("technique '{}' has no preset '{}'", info().name, name));
}

std::vector<std::string> technique_names() {
  std::vector<std::string> names;
  for (const Room& room : rooms) names.emplace_back(room.name);
  return names;
}

std::unique_ptr<Technique> make_technique(const std::string& name) {
  for (const Room& room : rooms)
    if (name == room.name) return room.make();
  throw UsageError(fmt::format("unknown technique '{}'", name));
}

}  // namespace izb
