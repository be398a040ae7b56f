// SPDX-License-Identifier: MIT
// Finding what a person names.
#pragma once
#include <fmt/format.h>

#include <algorithm>
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

/// The parts of a list "A;B;C", one if there is no semicolon; empty for an empty text.
inline std::vector<std::string> list_of(const std::string& text) {
  std::vector<std::string> parts;
  for (size_t at = 0; !text.empty() && at <= text.size();) {
    const size_t end = std::min(text.find(';', at), text.size());
    parts.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  return parts;
}

}  // namespace izb
