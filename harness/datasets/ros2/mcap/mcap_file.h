// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>

#include "harness/datasets/ros2/bag/chunked_file.h"
#include "harness/datasets/ros2/mcap/mcap_fields.h"

namespace vinebench::harness {

/// An MCAP file, read from its beginning without the index, which a recording that was interrupted
/// lacks and a broken file may have wrong. Chunks may be compressed by
/// Zstandard or LZ4. Checksums of
/// chunks are compared where there are any.
class McapFile : public ChunkedFile {
 public:
  explicit McapFile(const std::filesystem::path& file);

  void scan(const std::function<void(const BagMessage&)>& take) override;
  std::string cut_off() const override { return cut_off_; }
  std::int64_t start() const override { return start_; }

 private:
  using Take = std::function<void(const BagMessage&)>;
  struct Channel {
    std::string topic;
    std::string type;
    bool cdr = false;
  };
  struct Record {
    McapRecord kind{};
    std::uint64_t at = 0;  ///< of its fields, in the file
    std::uint64_t size = 0;
  };

  /// False at the end of the data; sets cut_off_.
  bool next_record(std::uint64_t& at, Record& record);
  void take_record(const Record& record, const Take& take);
  /// A schema, a channel or a message; `place` says where its fields begin.
  void take_fields(McapRecord kind, std::string_view fields, const MessagePlace& place,
                   const std::string& where, const Take& take);
  void take_message(std::string_view fields, const MessagePlace& place, const std::string& where,
                    const Take& take);
  void take_chunk(const Record& record, const Take& take);
  void read_metadata(const Record& record);
  /// Of the chunk whose fields are at that byte.
  std::string unpack_chunk(std::uint64_t at) const override;

  std::map<std::uint16_t, std::string> schemas_;
  std::map<std::uint16_t, Channel> channels_;
  std::string cut_off_;
  std::int64_t start_ = 0;
};

}  // namespace vinebench::harness
