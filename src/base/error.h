// SPDX-License-Identifier: MIT
// The two kinds of expected failure. Everything else is a bug and may terminate.
#pragma once
#include <fmt/format.h>

#include <stdexcept>
#include <string>
#include <utility>

namespace izb {

/// An expected failure. `what()` is one sentence for the person, naming the file or object and the cause.
/// Exit code 1.
struct Error : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Wrong usage of the command line. Exit code 2.
struct UsageError : Error {
  using Error::Error;
};

template <typename... Args>
[[noreturn]] void fail(fmt::format_string<Args...> text, Args&&... args) {
  throw Error(fmt::format(text, std::forward<Args>(args)...));
}

}  // namespace izb
