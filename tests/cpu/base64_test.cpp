// SPDX-License-Identifier: MIT
#include "base/base64.h"

#include <gtest/gtest.h>

namespace {

using izb::base64;

TEST(Base64, IsThatOfTheStandard) {  // RFC 4648, section 10
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64("\xff\xfe"), "//4=");
}

TEST(Base64, LongTextHasNoSeam) {
  // Longer than the parts in which it is made.
  const std::string text(size_t(3 << 20) * 2 + 1, 'f');
  const std::string encoded = base64(text);
  ASSERT_EQ(encoded.size(), (text.size() + 2) / 3 * 4);
  EXPECT_EQ(encoded.find_first_not_of("Zm"), encoded.size() - 3);  // "...ZmZmZg=="
  EXPECT_EQ(encoded.substr(encoded.size() - 8), "ZmZmZg==");
}

}  // namespace
