// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/ros2/bag/ros1_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>

#include "core/util/error.h"
#include "harness/datasets/ros/messages/ros_messages.h"
#include "harness/datasets/ros2/bag/unpack.h"
#include "harness/datasets/ros2/mcap/mcap_fields.h"

namespace vinebench::harness {
namespace {

constexpr std::string_view kMagic = "#ROSBAG V2.0\n";
constexpr std::size_t kLength = 4;  // bytes of the length before a header and before its data
constexpr std::uint64_t kMostHeader = 1 << 20;  // bytes

// The field "op" of a record's header.
constexpr char kMessage = 0x02, kChunk = 0x05, kConnection = 0x07;

std::uint32_t little_endian(std::string_view bytes) {
  std::array<char, kLength> raw{};
  bytes.copy(raw.data(), raw.size());
  return std::bit_cast<std::uint32_t>(raw);
}

/// Fields of a header, each a length and "name=value", whose value may be any bytes.
std::map<std::string, std::string, std::less<>> fields_of(std::string_view header,
                                                          const std::string& where) {
  std::map<std::string, std::string, std::less<>> fields;
  McapFieldReader in(header, where);
  while (!in.rest().empty()) {
    const std::string_view field = in.get_text();
    const std::size_t equals = field.find('=');
    if (equals == std::string_view::npos) fail("{}: expected a field 'name=value'", where);
    fields.insert_or_assign(std::string(field.substr(0, equals)),
                            std::string(field.substr(equals + 1)));
  }
  return fields;
}

template <class Fields>
std::string text_of(const Fields& fields, std::string_view name, const std::string& where) {
  const auto found = fields.find(name);
  if (found == fields.end()) fail("{}: expected a field '{}'", where, name);
  return found->second;
}

template <class Fields>
std::uint32_t number_of(const Fields& fields, std::string_view name, const std::string& where) {
  const std::string bytes = text_of(fields, name, where);
  if (bytes.size() != kLength) {
    fail("{}: {}: expected {} bytes, found {}", where, name, kLength, bytes.size());
  }
  return little_endian(bytes);
}

template <class Fields>
char kind_of(const Fields& fields) {
  const auto found = fields.find("op");
  return found != fields.end() && found->second.size() == 1 ? found->second[0] : '\0';
}

/// "sensor_msgs/Image" as ROS 2 names it: "sensor_msgs/msg/Image".
std::string type_of_ros2(std::string type) {
  const std::size_t slash = type.find('/');
  return slash == std::string::npos ? type : type.insert(slash, "/msg");
}

}  // namespace

Ros1File::Ros1File(const std::filesystem::path& file) : ChunkedFile(file) {
  if (!begins_with(kMagic)) {
    fail("{}: expected a bag of ROS 1, which begins with '#ROSBAG V2.0'", name().string());
  }
}

bool Ros1File::next_record(std::uint64_t& at, Record& record) {
  if (at == size()) return false;
  const auto left = [&](std::uint64_t from) { return size() - from; };
  const auto ends = [&] {
    cut_off_ = fmt::format("ends at byte {}, in the record at byte {}", size(), at);
    return false;
  };
  if (left(at) < kLength) return ends();
  const std::uint64_t header = little_endian(read_bytes(at, kLength));
  if (header > kMostHeader) {
    fail("{}: expected a header of at most {} bytes, found {}", place_text(at), kMostHeader,
         header);
  }
  if (left(at) < 2 * kLength + header) return ends();
  record.fields = fields_of(read_bytes(at + kLength, header), place_text(at));
  record.size = little_endian(read_bytes(at + kLength + header, kLength));
  record.at = at + 2 * kLength + header;
  if (left(record.at) < record.size) return ends();
  at = record.at + record.size;
  return true;
}

void Ros1File::scan(const Take& take) {
  std::uint64_t at = kMagic.size();
  Record record;
  while (next_record(at, record)) {
    const std::string where = place_text(record.at);
    const char kind = kind_of(record.fields);
    if (kind == kChunk) {
      take_chunk(record, take);
    } else if (kind == kConnection) {
      take_connection(record.fields, read_bytes(record.at, record.size), where);
    } else if (kind == kMessage) {
      take_message(record.fields, read_bytes(record.at, record.size),
                   {.block = 0, .offset = record.at, .size = record.size, .chunked = false}, where,
                   take);
    }  // others: the bag's header and its index
  }
}

void Ros1File::take_connection(const Fields& fields, std::string_view data,
                               const std::string& where) {
  const Fields description = fields_of(data, where);
  connections_[number_of(fields, "conn", where)] = {
      text_of(fields, "topic", where), type_of_ros2(text_of(description, "type", where))};
  const auto caller = description.find("callerid");
  if (caller != description.end() && caller->second == kRosCaller) start_ = kRosStart;
}

void Ros1File::take_message(const Fields& fields, std::string_view data, const MessagePlace& place,
                            const std::string& where, const Take& take) const {
  const std::uint32_t id = number_of(fields, "conn", where);
  const auto connection = connections_.find(id);
  if (connection == connections_.end()) {
    fail("{}: expected one of the connections before it, found {}", where, id);
  }
  take({connection->second.topic, connection->second.type, data, place, coding()});
}

void Ros1File::take_chunk(const Record& record, const Take& take) {
  const std::string compression = text_of(record.fields, "compression", place_text(record.at));
  const bool packed = compression != "none";
  if (packed) {
    const std::uint64_t size = number_of(record.fields, "size", place_text(record.at));
    packed_[record.at] = {compression, record.size, size};
  }
  const std::shared_ptr<const std::string> chunk =
      packed ? chunk_at(record.at)
             : std::make_shared<const std::string>(read_bytes(record.at, record.size));
  const std::string_view records(*chunk);
  for (std::uint64_t at = 0; at < records.size();) {
    MessagePlace place{.block = record.at, .offset = at, .size = 0, .chunked = packed};
    if (!packed) place.offset += record.at;
    const std::string where = fmt::format("{}: {}", name().string(), describe(place));
    McapFieldReader in(records.substr(at), where);
    const Fields fields = fields_of(in.get_text(), where);
    const std::string_view data = in.get_text();
    const std::uint64_t before = records.size() - at - in.rest().size() - data.size();
    at += before + data.size();
    place.offset += before;
    place.size = data.size();
    const char kind = kind_of(fields);
    if (kind == kConnection) take_connection(fields, data, where);
    if (kind == kMessage) take_message(fields, data, place, where, take);
  }
}

std::string Ros1File::unpack_chunk(std::uint64_t at) const {
  const Packed& packed = packed_.at(at);
  if (packed.unpacked > kMostMessageBytes) {
    fail("{}: expected a chunk of at most {} bytes, found {}", place_text(at), kMostMessageBytes,
         packed.unpacked);
  }
  try {
    return unpack(packed.compression, read_bytes(at, packed.size), packed.unpacked);
  } catch (const Error& error) {
    fail("{}: {}", place_text(at), error.what());
  }
}

}  // namespace vinebench::harness
