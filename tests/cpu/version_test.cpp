// SPDX-License-Identifier: MIT
#include "base/version.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <string>

namespace {

TEST(Version, IsThreeNumbers) {
  unsigned major = 0, minor = 0, patch = 0;
  ASSERT_EQ(std::sscanf(std::string(izb::version()).c_str(), "%u.%u.%u", &major, &minor, &patch), 3);
  EXPECT_EQ(izb::version(), std::to_string(major) + "." + std::to_string(minor) + "." + std::to_string(patch));
}

TEST(Version, CommitIsAHashOrUnknown) {
  const std::string commit(izb::commit());
  const bool hash =
      commit.size() >= 7 && commit.size() <= 40 && commit.find_first_not_of("0123456789abcdef") == std::string::npos;
  EXPECT_TRUE(hash || commit == "unknown") << commit;
}

}  // namespace
