// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "harness/datasets/files/append_file.h"
#include "harness/datasets/ros2/mcap/mcap_fields.h"

namespace vinebench::harness {

/// A topic of an MCAP file.
struct McapChannel {
  std::string topic;
  std::string schema;       ///< name
  std::string schema_text;  ///< ros2msg
  McapMap metadata;
  std::uint64_t messages = 0;  ///< written so far
};

/// What has been written so far.
struct McapStatistics {
  std::uint64_t messages = 0;
  std::uint64_t first_time = 0;  ///< ns
  std::uint64_t last_time = 0;   ///< ns
  std::uint32_t chunks = 0;
  std::uint32_t metadata = 0;
};

/// An MCAP file of messages in CDR, for ROS 2: chunks compressed by Zstandard, with an index of
/// their messages, a summary, and checksums of chunks, data and summary. A chunk is appended at
/// once, and only if the summary will fit on the disk too; a file that was never closed has whole
/// chunks and no summary. Throws Error with the system's reason.
class McapWriter {
 public:
  /// Replaces what has the file's name.
  McapWriter(std::filesystem::path file, const std::string& library);
  /// Closes it if possible.
  ~McapWriter();
  McapWriter(const McapWriter&) = delete;
  McapWriter& operator=(const McapWriter&) = delete;

  /// Before the first message.
  void write_metadata(const std::string& name, const McapMap& map);
  /// Returns the channel's number.
  std::size_t add_channel(McapChannel channel);
  /// `time` in ns.
  void write(std::size_t channel, std::uint64_t time, std::string_view message);
  /// Compresses and appends the messages since the last call; where that fails they are dropped.
  void end_chunk();
  void close();

  const std::vector<McapChannel>& channels() const { return channels_; }
  const McapStatistics& statistics() const { return statistics_; }

 private:
  struct Entry {
    std::uint64_t time = 0;
    std::uint64_t offset = 0;  ///< in the chunk
  };
  /// Messages that wait for the end of their chunk.
  struct Pending {
    std::string records;
    std::vector<std::vector<Entry>> entries;  ///< by channel
    std::uint64_t first_time = 0;
    std::uint64_t last_time = 0;
    std::uint64_t messages = 0;
  };

  void append(std::string_view bytes);
  void describe(std::size_t channel);
  std::string index_of(const Pending& chunk, const std::string& record, std::string& indices) const;
  void expect_room(std::uint64_t bytes) const;
  void count(const Pending& chunk);
  std::string statistics_record() const;
  std::string summary() const;

  std::filesystem::path file_;
  AppendFile out_;
  std::uint64_t size_ = 0;  ///< bytes of the file
  std::uint32_t crc_ = 0;   ///< of these
  bool closed_ = false;
  std::vector<McapChannel> channels_;
  std::vector<bool> described_;  ///< channels whose records are in a chunk
  Pending chunk_;
  McapStatistics statistics_;
  std::string chunk_indices_;     ///< records of the summary
  std::string metadata_indices_;  ///< likewise
};

}  // namespace vinebench::harness
