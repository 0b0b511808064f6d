// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/ros2/cdr/cdr_reader.h"

#include <gmock/gmock.h>

#include "harness/datasets/ros2/cdr/cdr_writer.h"
#include "tests/support/test_folder.h"

namespace vinebench::harness {
namespace {

using test::error_of;
using testing::ElementsAre;
using testing::HasSubstr;
using namespace std::string_literals;

TEST(CdrTest, NumbersAreAlignedToTheirSizeAfterTheEncapsulation) {
  CdrWriter out;
  out.put(std::uint8_t{7});
  out.put(std::uint32_t{0x01020304});
  out.put(1.0);  // at byte 8: 0x3ff0000000000000
  out.put_text("ab");
  out.put(std::uint16_t{5});
  EXPECT_EQ(out.take(),
            "\0\1\0\0"s
            "\7\0\0\0\4\3\2\1\0\0\0\0\0\0\xf0\x3f"s
            "\3\0\0\0ab\0\0"s  // three with the zero at the end, one of alignment
            "\5\0"s);
}

TEST(CdrTest, WhatIsWrittenIsRead) {
  CdrWriter out;
  out.put(true);
  out.put_text("frame");
  out.put_numbers({1.5, -2});
  out.put_bytes("\1\0\2"s);
  out.put_array(std::array<double, 2>{3, 4});
  const std::string message = out.take();
  CdrReader in(message);
  EXPECT_TRUE(in.get<bool>());
  EXPECT_EQ(in.get_text(), "frame");
  EXPECT_THAT(in.get_numbers(), ElementsAre(1.5, -2));
  EXPECT_EQ(in.get_bytes(), "\1\0\2"s);
  std::array<double, 2> numbers{};
  in.get_array(numbers);
  EXPECT_THAT(numbers, ElementsAre(3, 4));
  EXPECT_EQ(error_of([&] { in.get<std::uint8_t>(); }),
            fmt::format("byte {}: expected 1 more bytes, found 0", message.size()));
}

TEST(CdrTest, BigEndianMessagesAreRead) {
  const std::string message =
      "\0\0\0\0"s
      "\1\0\0\0"s
      "\0\0\0\3"s
      "\xc0\0\0\0\0\0\0\0"s;
  CdrReader in(message);
  EXPECT_EQ(in.get<std::uint8_t>(), 1);
  EXPECT_EQ(in.get<std::uint32_t>(), 3u);
  EXPECT_EQ(in.get<double>(), -2.0);  // 0xc000000000000000
}

TEST(CdrTest, LengthsAreHeldAgainstWhatIsThere) {
  const std::string huge = "\0\1\0\0\xff\xff\xff\xff"s;
  EXPECT_EQ(error_of([&] { CdrReader(huge).get_text(); }),
            "byte 8: expected 4294967295 elements, found 0 bytes");
  EXPECT_THAT(error_of([&] { CdrReader(huge).get_bytes(); }), HasSubstr("expected 4294967295"));
  EXPECT_THAT(error_of([&] { CdrReader(huge).get_numbers(); }), HasSubstr("expected 4294967295"));
  // Two numbers need 16 bytes.
  EXPECT_THAT(
      error_of([&] { CdrReader("\0\1\0\0\2\0\0\0"s + std::string(12, '\0')).get_numbers(); }),
      HasSubstr("expected 2 elements, found 12 bytes"));
}

TEST(CdrTest, OtherEncapsulationsAreRefused) {
  EXPECT_EQ(error_of([] { CdrReader("\0\7\0\0"s); }),
            "byte 0: expected plain CDR (encapsulation 0 or 1), found 7");
  EXPECT_EQ(error_of([] { CdrReader("\xff\x01\0\0"s); }),
            "byte 0: expected plain CDR (encapsulation 0 or 1), found 65281");
  EXPECT_EQ(error_of([] { CdrReader("\0\1"s); }), "byte 0: expected 4 more bytes, found 2");
}

}  // namespace
}  // namespace vinebench::harness
