// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace vinebench::harness {

/// How a message's bytes hold its values.
enum class MessageCoding {
  kCdr,   ///< ROS 2: plain CDR with its encapsulation
  kRos1,  ///< ROS 1: little-endian without gaps; headers begin with a number of their own
};

/// A message as it is in a bag.
struct EncodedMessage {
  std::string_view bytes;
  MessageCoding coding = MessageCoding::kCdr;

  // Not explicit: bytes alone are those of ROS 2.
  EncodedMessage(std::string_view all, MessageCoding how = MessageCoding::kCdr)
      : bytes(all), coding(how) {}
  EncodedMessage(const std::string& all) : bytes(all) {}
};

}  // namespace vinebench::harness
