// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/ros2/mcap/mcap_writer.h"

#include <libdeflate.h>

#include <algorithm>
#include <cstring>
#include <utility>

#include "core/files/disk_room.h"
#include "core/util/error.h"
#include "harness/datasets/ros2/mcap/zstd.h"

namespace vinebench::harness {
namespace {

// Bytes at most of the summary's records whose number does not grow, with the file's end.
constexpr std::uint64_t kEndOfFile = 1024;

std::uint16_t number_of(std::size_t channel) {
  return static_cast<std::uint16_t>(channel);
}

/// Schemas are numbered from 1: 0 is "none".
std::string schema_record(std::size_t channel, const McapChannel& described) {
  return McapFields()
      .put(static_cast<std::uint16_t>(channel + 1))
      .put_text(described.schema)
      .put_text("ros2msg")
      .put_text(described.schema_text)
      .record(McapRecord::kSchema);
}

std::string channel_record(std::size_t channel, const McapChannel& described) {
  return McapFields()
      .put(number_of(channel))
      .put(static_cast<std::uint16_t>(channel + 1))
      .put_text(described.topic)
      .put_text("cdr")
      .put_map(described.metadata)
      .record(McapRecord::kChannel);
}

std::uint32_t crc_of(std::string_view bytes, std::uint32_t crc = 0) {
  return libdeflate_crc32(crc, bytes.data(), bytes.size());
}

}  // namespace

McapWriter::McapWriter(std::filesystem::path file, const std::string& library)
    : file_(std::move(file)), out_(file_) {
  const std::string head =
      McapFields().put_text("ros2").put_text(library).record(McapRecord::kHeader);
  append(std::string(kMcapMagic) + head);
}

McapWriter::~McapWriter() {
  try {
    close();
  } catch (const Error&) {  // the error was reported before; the chunks can be read
  }
}

void McapWriter::append(std::string_view bytes) {
  out_.append(bytes);
  size_ += bytes.size();
  crc_ = crc_of(bytes, crc_);
}

void McapWriter::write_metadata(const std::string& name, const McapMap& map) {
  const std::string record = McapFields().put_text(name).put_map(map).record(McapRecord::kMetadata);
  metadata_indices_ += McapFields()
                           .put(size_)
                           .put(std::uint64_t{record.size()})
                           .put_text(name)
                           .record(McapRecord::kMetadataIndex);
  append(record);
  ++statistics_.metadata;
}

std::size_t McapWriter::add_channel(McapChannel channel) {
  if (channels_.size() > 0xfffe) fail("{}: too many topics", file_.string());
  channels_.push_back(std::move(channel));
  described_.push_back(false);
  chunk_.entries.emplace_back();
  return channels_.size() - 1;
}

void McapWriter::describe(std::size_t channel) {
  if (described_[channel] || !chunk_.entries[channel].empty()) return;
  chunk_.records += schema_record(channel, channels_[channel]);
  chunk_.records += channel_record(channel, channels_[channel]);
}

void McapWriter::write(std::size_t channel, std::uint64_t time, std::string_view message) {
  describe(channel);
  std::vector<Entry>& entries = chunk_.entries[channel];
  entries.push_back({time, chunk_.records.size()});
  const std::uint64_t sequence = channels_[channel].messages + entries.size() - 1;
  chunk_.records += McapFields()
                        .put(number_of(channel))
                        .put(static_cast<std::uint32_t>(sequence))
                        .put(time)  // when it was recorded, when it was sent
                        .put(time)
                        .put_bytes(message)
                        .record(McapRecord::kMessage);
  chunk_.first_time = chunk_.messages == 0 ? time : std::min(chunk_.first_time, time);
  chunk_.last_time = std::max(chunk_.last_time, time);
  ++chunk_.messages;
}

void McapWriter::end_chunk() {
  if (chunk_.messages == 0) return;
  Pending chunk;
  chunk.entries.resize(channels_.size());
  std::swap(chunk, chunk_);
  const std::string data = zstd_compress(chunk.records);
  const std::string record = McapFields()
                                 .put(chunk.first_time)
                                 .put(chunk.last_time)
                                 .put(std::uint64_t{chunk.records.size()})
                                 .put(crc_of(chunk.records))
                                 .put_text("zstd")
                                 .put(std::uint64_t{data.size()})
                                 .put_bytes(data)
                                 .record(McapRecord::kChunk);
  std::string indices;
  McapFields index;
  index.put(chunk.first_time).put(chunk.last_time).put(size_).put(std::uint64_t{record.size()});
  index.put_text(index_of(chunk, record, indices)).put(std::uint64_t{indices.size()});
  index.put_text("zstd").put(std::uint64_t{data.size()});
  index.put(std::uint64_t{chunk.records.size()});
  expect_room(record.size() + indices.size() + index.bytes().size());
  append(record + indices);
  chunk_indices_ += index.record(McapRecord::kChunkIndex);
  count(chunk);
}

/// For a chunk with a line of the summary, and for the whole summary.
void McapWriter::expect_room(std::uint64_t bytes) const {
  bytes += chunk_indices_.size() + metadata_indices_.size() + kEndOfFile;
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    bytes += schema_record(i, channels_[i]).size() + channel_record(i, channels_[i]).size();
    bytes += sizeof(std::uint16_t) + sizeof(std::uint64_t);  // its count in the statistics
  }
  if (const int reason = lack_of_room(file_, bytes); reason != 0) {
    fail("{}: cannot be written: {}", file_.string(), std::strerror(reason));
  }
}

/// Makes the records that follow a chunk, and returns their offsets by channel.
std::string McapWriter::index_of(const Pending& chunk, const std::string& record,
                                 std::string& indices) const {
  McapFields offsets;
  for (std::size_t channel = 0; channel < chunk.entries.size(); ++channel) {
    if (chunk.entries[channel].empty()) continue;
    offsets.put(number_of(channel)).put(size_ + record.size() + indices.size());
    McapFields entries;
    for (const Entry& entry : chunk.entries[channel]) entries.put(entry.time).put(entry.offset);
    indices += McapFields()
                   .put(number_of(channel))
                   .put_text(entries.bytes())
                   .record(McapRecord::kMessageIndex);
  }
  return offsets.bytes();
}

void McapWriter::count(const Pending& chunk) {
  for (std::size_t i = 0; i < chunk.entries.size(); ++i) {
    channels_[i].messages += chunk.entries[i].size();
    if (!chunk.entries[i].empty()) described_[i] = true;
  }
  McapStatistics& all = statistics_;
  all.first_time =
      all.messages == 0 ? chunk.first_time : std::min(all.first_time, chunk.first_time);
  all.last_time = std::max(all.last_time, chunk.last_time);
  all.messages += chunk.messages;
  ++all.chunks;
}

std::string McapWriter::statistics_record() const {
  McapFields counts;
  std::uint32_t topics = 0;
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    if (!described_[i]) continue;
    counts.put(number_of(i)).put(channels_[i].messages);
    ++topics;
  }
  const McapStatistics& all = statistics_;
  return McapFields()
      .put(all.messages)
      .put(static_cast<std::uint16_t>(topics))  // schemas
      .put(topics)                              // channels
      .put(std::uint32_t{0})                    // attachments
      .put(all.metadata)
      .put(all.chunks)
      .put(all.first_time)
      .put(all.last_time)
      .put_text(counts.bytes())
      .record(McapRecord::kStatistics);
}

/// Groups of records by kind, and where they are, with the place of the latter in the footer.
std::string McapWriter::summary() const {
  std::string schemas, channels;
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    if (!described_[i]) continue;
    schemas += schema_record(i, channels_[i]);
    channels += channel_record(i, channels_[i]);
  }
  const std::pair<McapRecord, std::string> groups[] = {
      {McapRecord::kSchema, std::move(schemas)},
      {McapRecord::kChannel, std::move(channels)},
      {McapRecord::kStatistics, statistics_record()},
      {McapRecord::kChunkIndex, chunk_indices_},
      {McapRecord::kMetadataIndex, metadata_indices_}};
  std::string records, offsets;
  for (const auto& [kind, group] : groups) {
    if (group.empty()) continue;
    offsets += McapFields()
                   .put(static_cast<std::uint8_t>(kind))
                   .put(size_ + records.size())
                   .put(std::uint64_t{group.size()})
                   .record(McapRecord::kSummaryOffset);
    records += group;
  }
  const std::uint64_t offsets_start = size_ + records.size();
  McapFields footer;
  footer.put(size_).put(offsets_start);
  constexpr std::uint64_t kFooterSize = 20;
  McapFields checked;  // the checksum covers the summary and what is before it in the footer
  checked.put_bytes(records + offsets).put(static_cast<std::uint8_t>(McapRecord::kFooter));
  checked.put(kFooterSize).put_bytes(footer.bytes());
  return checked.put(crc_of(checked.bytes())).bytes();
}

void McapWriter::close() {
  if (std::exchange(closed_, true)) return;
  end_chunk();
  append(McapFields().put(crc_).record(McapRecord::kDataEnd));
  append(summary() + std::string(kMcapMagic));
}

}  // namespace vinebench::harness
