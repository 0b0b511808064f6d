// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include "harness/datasets/ros2/cdr/encoded_message.h"

namespace vinebench::harness {

/// Bytes of a message at most, and of a chunk without compression.
inline constexpr std::uint64_t kMostMessageBytes = std::uint64_t{256} << 20;

/// Where a message is in its file.
struct MessagePlace {
  std::uint64_t block = 0;   ///< byte of the file where its chunk is; SQLite: its row
  std::uint64_t offset = 0;  ///< byte of the message's data in the chunk, or in the file
  std::uint64_t size = 0;    ///< bytes of its data
  bool chunked = false;
};

/// A message as it is scanned; texts and data are those of the file, during the call.
struct BagMessage {
  const std::string& topic;
  const std::string& type;  ///< "sensor_msgs/msg/Image"
  std::string_view data;
  MessagePlace place;
  MessageCoding coding = MessageCoding::kCdr;

  EncodedMessage encoded() const { return {data, coding}; }
};

/// A file of a bag, which may be broken or made to do harm. Everything throws Error, which
/// names the file and the place in it.
class BagFile {
 public:
  virtual ~BagFile() = default;

  /// All messages in coding(), in the order of the file.
  virtual void scan(const std::function<void(const BagMessage&)>& take) = 0;
  /// A message's data again; on any thread, concurrently.
  virtual std::string read(const MessagePlace& place) const = 0;
  virtual MessageCoding coding() const { return MessageCoding::kCdr; }
  /// The place for people: "byte 1234", "row 12".
  virtual std::string describe(const MessagePlace& place) const = 0;
  /// After scan(): what a file that ends too early lacks; empty for a whole one.
  virtual std::string cut_off() const { return ""; }
  /// After scan(): what the times are ahead of the stamps of a recording of ours, ns.
  virtual std::int64_t start() const { return 0; }
};

}  // namespace vinebench::harness
