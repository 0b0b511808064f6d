// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/ros2/mcap/mcap_file.h"

#include <libdeflate.h>

#include <charconv>

#include "core/time.h"
#include "core/util/error.h"
#include "harness/datasets/ros2/bag/bag_metadata.h"
#include "harness/datasets/ros2/bag/unpack.h"

namespace vinebench::harness {
namespace {

constexpr std::size_t kMessageHead = 22;  // bytes of a message's fields before its data

}  // namespace

McapFile::McapFile(const std::filesystem::path& file) : ChunkedFile(file) {
  if (!begins_with(kMcapMagic)) {
    fail("{}: expected an MCAP file, which begins with \\x89MCAP0", name().string());
  }
}

bool McapFile::next_record(std::uint64_t& at, Record& record) {
  const std::uint64_t left = size() - at;
  if (left < kMcapRecordHead) {
    cut_off_ = fmt::format("ends at byte {}, before the end of its data", size());
    return false;
  }
  const std::string head = read_bytes(at, kMcapRecordHead);
  McapFieldReader fields(head, place_text(at));
  record.kind = static_cast<McapRecord>(fields.get<std::uint8_t>());
  record.size = fields.get<std::uint64_t>();
  record.at = at + kMcapRecordHead;
  if (record.kind == McapRecord::kDataEnd || record.kind == McapRecord::kFooter) return false;
  if (record.size > left - kMcapRecordHead) {
    cut_off_ = fmt::format("ends at byte {}, in the record at byte {}", size(), at);
    return false;
  }
  at = record.at + record.size;
  return true;
}

void McapFile::scan(const Take& take) {
  std::uint64_t at = kMcapMagic.size();
  Record record;
  while (next_record(at, record)) take_record(record, take);
}

void McapFile::take_record(const Record& record, const Take& take) {
  switch (record.kind) {
    case McapRecord::kChunk:
      return take_chunk(record, take);
    case McapRecord::kMetadata:
      return read_metadata(record);
    case McapRecord::kSchema:
    case McapRecord::kChannel:
    case McapRecord::kMessage:
      return take_fields(record.kind, read_bytes(record.at, record.size), {.offset = record.at},
                         place_text(record.at), take);
    default:  // indices, attachments, and kinds that are not known yet
      return;
  }
}

void McapFile::take_fields(McapRecord kind, std::string_view fields, const MessagePlace& place,
                           const std::string& where, const Take& take) {
  if (kind == McapRecord::kMessage) return take_message(fields, place, where, take);
  McapFieldReader in(fields, where);
  const auto id = in.get<std::uint16_t>();
  if (kind == McapRecord::kSchema) {
    schemas_[id] = std::string(in.get_text());
    return;
  }
  const auto schema = in.get<std::uint16_t>();
  Channel channel;
  channel.topic = std::string(in.get_text());
  channel.cdr = in.get_text() == "cdr";
  if (const auto known = schemas_.find(schema); known != schemas_.end()) {
    channel.type = known->second;
  } else if (schema != 0) {
    fail("{}: topic {}: expected one of the schemas before it, found {}", where, channel.topic,
         schema);
  }
  channels_[id] = std::move(channel);
}

void McapFile::take_message(std::string_view fields, const MessagePlace& place,
                            const std::string& where, const Take& take) {
  McapFieldReader in(fields, where);
  const auto id = in.get<std::uint16_t>();
  const auto channel = channels_.find(id);
  if (channel == channels_.end()) {
    fail("{}: expected one of the channels before it, found {}", where, id);
  }
  in.take(kMessageHead - sizeof(id));
  if (!channel->second.cdr) return;
  MessagePlace data = place;
  data.offset += kMessageHead;
  data.size = in.rest().size();
  take({channel->second.topic, channel->second.type, in.rest(), data});
}

void McapFile::take_chunk(const Record& record, const Take& take) {
  const std::shared_ptr<const std::string> chunk = chunk_at(record.at);
  const std::string_view records(*chunk);
  for (std::uint64_t at = 0; at < records.size();) {
    MessagePlace place{.block = record.at, .offset = at, .chunked = true};
    const auto where = [&] { return fmt::format("{}: {}", name().string(), describe(place)); };
    if (records.size() - at < kMcapRecordHead) fail("{}: expected a record", where());
    McapFieldReader in(records.substr(at), "");
    const auto kind = static_cast<McapRecord>(in.get<std::uint8_t>());
    const auto size = in.get<std::uint64_t>();
    if (size > in.rest().size()) {
      fail("{}: expected {} more bytes, found {}", where(), size, in.rest().size());
    }
    place.offset += kMcapRecordHead;
    at = place.offset + size;
    if (kind == McapRecord::kMessage || kind == McapRecord::kSchema ||
        kind == McapRecord::kChannel) {
      take_fields(kind, in.rest().substr(0, size), place, where(), take);
    }
  }
}

/// Ours has the time of stamp 0.
void McapFile::read_metadata(const Record& record) {
  const std::string bytes = read_bytes(record.at, record.size);
  McapFieldReader in(bytes, place_text(record.at));
  if (in.get_text() != kOurMetadata) return;
  const McapMap map = in.get_map();
  const auto found = map.find(kStartKey);
  if (found == map.end()) return;
  const std::string& text = found->second;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), start_);
  if (error != std::errc() || end != text.data() + text.size() || !is_in_range(start_)) {
    fail("{}: {}: expected a time in ns, found '{}'", place_text(record.at), kStartKey, text);
  }
}

std::string McapFile::unpack_chunk(std::uint64_t at) const {
  const std::string head = read_bytes(at - sizeof(std::uint64_t), sizeof(std::uint64_t));
  const auto size = McapFieldReader(head, place_text(at)).get<std::uint64_t>();
  const std::string bytes = read_bytes(at, size);
  McapFieldReader in(bytes, place_text(at));
  in.take(2 * sizeof(std::uint64_t));  // times of the first and the last message
  const auto unpacked = in.get<std::uint64_t>();
  const auto crc = in.get<std::uint32_t>();
  const std::string compression(in.get_text());
  const std::string_view data = in.take(in.get<std::uint64_t>());
  if (unpacked > kMostMessageBytes) {
    fail("{}: expected a chunk of at most {} bytes, found {}", place_text(at), kMostMessageBytes,
         unpacked);
  }
  std::string records;
  try {
    records = unpack(compression, data, unpacked);
  } catch (const Error& error) {
    fail("{}: {}", place_text(at), error.what());
  }
  if (crc != 0 && libdeflate_crc32(0, records.data(), records.size()) != crc) {
    fail("{}: the chunk is damaged: its checksum differs", place_text(at));
  }
  return records;
}

}  // namespace vinebench::harness
