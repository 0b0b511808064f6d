// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/util/base64.h"

#include <gtest/gtest.h>

namespace vinebench {
namespace {

// RFC 4648, section 10.
TEST(Base64Test, HasTheStandardsExamples) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foob"), "Zm9vYg==");
  EXPECT_EQ(base64("fooba"), "Zm9vYmE=");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
}

TEST(Base64Test, TakesEveryByte) {
  // 0xfb 0xff 0xfe is 111110 111111 111111 111110: digits 62, 63, 63, 62.
  EXPECT_EQ(base64("\xfb\xff\xfe"), "+//+");
  EXPECT_EQ(base64(std::string(3, '\0')), "AAAA");
}

}  // namespace
}  // namespace vinebench
