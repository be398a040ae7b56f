// SPDX-License-Identifier: MIT
// What the tests with a GL context share. main.cpp makes the context before the first test and fails every
// test during which GL reported an error or a message of high severity.
#pragma once
#include "gpu/capabilities.h"

namespace izb::test {

/// Of the context that $IZB_TEST_CONTEXT names ("egl" if unset).
const gpu::Capabilities& capabilities();

/// The first of these GL extensions that the driver lacks, or "".
inline std::string first_lacking(const std::vector<std::string>& extensions) {
  for (const std::string& name : extensions)
    if (!capabilities().has(name)) return name;
  return {};
}

/// Says that the running test has provoked this many GL messages on purpose.
void expect_debug_messages(int count);

}  // namespace izb::test
