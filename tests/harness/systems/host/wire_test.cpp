// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/systems/host/wire.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <thread>

#include "tests/support/test_folder.h"

namespace vinebench::harness {
namespace {

using testing::HasSubstr;

class WireTest : public testing::Test {
 protected:
  WireTest() { EXPECT_EQ(socketpair(AF_UNIX, SOCK_STREAM, 0, ends_.data()), 0); }
  ~WireTest() override {
    for (const int end : ends_) close(end);
  }
  std::array<int, 2> ends_{};
};

TEST(MessageTest, WhatIsWrittenIsRead) {
  MessageWriter writer;
  writer.add(2.5);
  writer.add_text("front_left");
  const std::array<std::int32_t, 3> numbers{4, -5, 6};
  writer.add_list(numbers.data(), numbers.size());
  writer.add_list(numbers.data(), 0);
  MessageReader reader(writer.content());
  EXPECT_EQ(reader.read<double>(), 2.5);
  EXPECT_EQ(reader.read_text(), "front_left");
  EXPECT_THAT(reader.read_list<std::int32_t>(), testing::ElementsAre(4, -5, 6));
  EXPECT_TRUE(reader.read_list<std::int32_t>().empty());
}

// Also a length of 2^61 eight-byte numbers, whose bytes are 2^64: none of that is allocated.
TEST(MessageTest, AMessageThatIsTooShortIsAnError) {
  MessageWriter writer;
  writer.add(std::uint64_t{1} << 61);
  const std::string& content = writer.content();
  EXPECT_THAT(test::error_of([&] { MessageReader(content).read_list<double>(); }),
              HasSubstr("shorter than it says"));
  EXPECT_THAT(test::error_of([&] { MessageReader(content).read_text(); }),
              HasSubstr("shorter than it says"));
  EXPECT_THAT(test::error_of([&] { MessageReader(content).read<std::array<char, 9>>(); }),
              HasSubstr("shorter than it says"));
}

// More than a socket holds: it goes through in parts.
TEST_F(WireTest, LargeMessagesArriveWhole) {
  const std::string large(5'000'000, 'x');
  std::thread sender([&] { send_message(ends_[0], MessageKind::kSummary, large, wait_for_ever); });
  const std::optional<Message> message = receive_message(ends_[1], wait_for_ever);
  sender.join();
  EXPECT_EQ(message.value().kind, MessageKind::kSummary);
  EXPECT_EQ(message->content, large);
}

TEST_F(WireTest, TheEndOfTheOtherSideIsNoMessage) {
  const std::array<std::uint32_t, 2> half{static_cast<std::uint32_t>(MessageKind::kSummary), 10};
  EXPECT_EQ(write(ends_[0], half.data(), sizeof(half)), 8);
  shutdown(ends_[0], SHUT_RDWR);
  EXPECT_FALSE(receive_message(ends_[1], wait_for_ever));
  EXPECT_THAT(
      test::error_of([&] { send_message(ends_[1], MessageKind::kFinish, "", wait_for_ever); }),
      HasSubstr("the other side of a socket is gone"));
}

TEST_F(WireTest, WhatIsNoMessageIsAnError) {
  const std::array<std::uint32_t, 2> unknown{99, 0};
  EXPECT_EQ(write(ends_[0], unknown.data(), sizeof(unknown)), 8);
  EXPECT_THAT(test::error_of([&] { receive_message(ends_[1], wait_for_ever); }),
              HasSubstr("kind 99"));
}

TEST_F(WireTest, AWaitMayGiveUp) {
  const auto give_up = [](int, short events) { fail("no time for {}", events); };
  EXPECT_THAT(test::error_of([&] { receive_message(ends_[1], give_up); }),
              HasSubstr(fmt::format("no time for {}", POLLIN)));
  const std::string large(5'000'000, 'x');
  EXPECT_THAT(test::error_of([&] { send_message(ends_[0], MessageKind::kCreate, large, give_up); }),
              HasSubstr(fmt::format("no time for {}", POLLOUT)));
}

}  // namespace
}  // namespace vinebench::harness
