// SPDX-License-Identifier: MIT
// Messages for the person go to stderr; stdout carries results only.
#pragma once
#include <fmt/format.h>

#include <cstdio>
#include <utility>

namespace izb {

template <typename... Args>
void note(fmt::format_string<Args...> text, Args&&... args) {
  fmt::print(stderr, "izb: {}\n", fmt::format(text, std::forward<Args>(args)...));
}

template <typename... Args>
void warn(fmt::format_string<Args...> text, Args&&... args) {
  fmt::print(stderr, "izb: warning: {}\n", fmt::format(text, std::forward<Args>(args)...));
}

}  // namespace izb
