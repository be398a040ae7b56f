// SPDX-License-Identifier: MIT
// Finding what a person names.
#pragma once
#include <fmt/format.h>

#include <charconv>
#include <string>
#include <vector>

namespace izb {

/// The first object called so, else the one at that index, else null.
template <typename T>
const T* find_by_name_or_index(const std::vector<T>& objects, const std::string& name) {
  for (const T& object : objects)
    if (object.name == name) return &object;
  size_t index = 0;
  const char* const end = name.data() + name.size();
  const auto [rest, error] = std::from_chars(name.data(), end, index);
  return error == std::errc() && rest == end && index < objects.size() ? &objects[index] : nullptr;
}

/// "0 'first', 1 'second'".
template <typename T>
std::string names_of(const std::vector<T>& objects) {
  std::string names;
  for (size_t i = 0; i < objects.size(); ++i) names += fmt::format("{}{} '{}'", i == 0 ? "" : ", ", i, objects[i].name);
  return names;
}

}  // namespace izb
