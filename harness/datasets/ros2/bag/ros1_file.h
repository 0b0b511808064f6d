// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <unordered_map>

#include "harness/datasets/ros2/bag/chunked_file.h"

namespace vinebench::harness {

/// A bag of ROS 1, format 2.0 (wiki.ros.org/Bags/Format/2.0), read from its beginning, without its
/// index; a bag that was not closed is read up to its last whole record.
class Ros1File : public ChunkedFile {
 public:
  explicit Ros1File(const std::filesystem::path& file);

  void scan(const std::function<void(const BagMessage&)>& take) override;
  MessageCoding coding() const override { return MessageCoding::kRos1; }
  std::string cut_off() const override { return cut_off_; }
  std::int64_t start() const override { return start_; }

 private:
  using Take = std::function<void(const BagMessage&)>;
  using Fields = std::map<std::string, std::string, std::less<>>;

  /// A record's header and where its data are.
  struct Record {
    Fields fields;
    std::uint64_t at = 0;    ///< byte of its data
    std::uint64_t size = 0;  ///< bytes of its data
  };
  struct Connection {
    std::string topic;
    std::string type;
  };

  /// Advances to the record after it. False at the end of the file, which may be too early.
  bool next_record(std::uint64_t& at, Record& record);
  void take_chunk(const Record& record, const Take& take);
  void take_connection(const Fields& fields, std::string_view data, const std::string& where);
  void take_message(const Fields& fields, std::string_view data, const MessagePlace& place,
                    const std::string& where, const Take& take) const;
  /// Of a compressed chunk whose data begin at that byte.
  std::string unpack_chunk(std::uint64_t at) const override;

  struct Packed {
    std::string compression;
    std::uint64_t size = 0;      ///< bytes in the file
    std::uint64_t unpacked = 0;  ///< bytes without compression
  };

  std::unordered_map<std::uint32_t, Connection> connections_;
  std::map<std::uint64_t, Packed> packed_;  ///< compressed chunks, by the byte of their data
  std::string cut_off_;
  std::int64_t start_ = 0;
};

}  // namespace vinebench::harness
