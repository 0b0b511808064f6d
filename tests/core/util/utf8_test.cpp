// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/util/utf8.h"

#include <gtest/gtest.h>

namespace vinebench {
namespace {

const std::string kUnknown = "\xef\xbf\xbd";  // U+FFFD

// U+007F, U+0080, U+07FF, U+0800, U+D7FF, U+E000, U+FFFF, U+10000, U+10FFFF: the first and last
// characters of each length, and the neighbours of the surrogates.
TEST(Utf8Test, ValidTextIsUnchanged) {
  const std::string text =
      "\x7f \xc2\x80 \xdf\xbf \xe0\xa0\x80 \xed\x9f\xbf \xee\x80\x80 \xef\xbf\xbf "
      "\xf0\x90\x80\x80 \xf4\x8f\xbf\xbf";
  EXPECT_EQ(valid_utf8(text), text);
  EXPECT_EQ(valid_utf8(""), "");
}

TEST(Utf8Test, EachInvalidByteIsReplaced) {
  EXPECT_EQ(valid_utf8("a\xff z"), "a" + kUnknown + " z");
  EXPECT_EQ(valid_utf8("caf\xe9"), "caf" + kUnknown);                     // Latin-1
  EXPECT_EQ(valid_utf8("\xc0\xaf"), kUnknown + kUnknown);                 // overlong
  EXPECT_EQ(valid_utf8("\xe0\x9f\xbf"), kUnknown + kUnknown + kUnknown);  // overlong
  EXPECT_EQ(valid_utf8("\xed\xa0\x80"), kUnknown + kUnknown + kUnknown);  // surrogate
  EXPECT_EQ(valid_utf8("\xf4\x90\x80\x80").size(), 4 * kUnknown.size());  // U+110000
  EXPECT_EQ(valid_utf8("\xf0\x8f\xbf\xbf").size(), 4 * kUnknown.size());  // overlong
  EXPECT_EQ(valid_utf8("\xe2\x82"), kUnknown + kUnknown);                 // cut off
}

}  // namespace
}  // namespace vinebench
