// SPDX-License-Identifier: MIT
#include "base/version.h"

#include <gtest/gtest.h>

#include <regex>
#include <string>

namespace {

TEST(Version, IsThreeNumbers) {
  EXPECT_TRUE(std::regex_match(std::string(izb::version()), std::regex("[0-9]+\\.[0-9]+\\.[0-9]+")));
}

TEST(Version, CommitIsAHashOrUnknown) {
  EXPECT_TRUE(std::regex_match(std::string(izb::commit()), std::regex("[0-9a-f]{7,40}|unknown")));
}

}  // namespace
