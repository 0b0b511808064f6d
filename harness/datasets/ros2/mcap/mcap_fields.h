// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <type_traits>

namespace vinebench::harness {

// MCAP (https://mcap.dev/spec): a file of records, each a byte that says which, its length and its
// fields; little-endian without gaps.

static_assert(std::endian::native == std::endian::little, "MCAP is little-endian");

/// At both ends of a file.
inline constexpr std::string_view kMcapMagic{"\x89MCAP0\r\n", 8};

enum class McapRecord : std::uint8_t {
  kHeader = 0x01,
  kFooter = 0x02,
  kSchema = 0x03,
  kChannel = 0x04,
  kMessage = 0x05,
  kChunk = 0x06,
  kMessageIndex = 0x07,
  kChunkIndex = 0x08,
  kStatistics = 0x0b,
  kMetadata = 0x0c,
  kMetadataIndex = 0x0d,
  kSummaryOffset = 0x0e,
  kDataEnd = 0x0f,
};

/// Bytes of a record before its fields.
inline constexpr std::size_t kMcapRecordHead = 9;

using McapMap = std::map<std::string, std::string>;

/// The fields of a record, one after the other.
class McapFields {
 public:
  template <class T>
  McapFields& put(T value) {
    static_assert(std::is_unsigned_v<T>);
    const auto raw = std::bit_cast<std::array<char, sizeof(T)>>(value);
    bytes_.append(raw.data(), raw.size());
    return *this;
  }
  McapFields& put_text(std::string_view text) {
    put(static_cast<std::uint32_t>(text.size()));
    return put_bytes(text);
  }
  /// Without their length.
  McapFields& put_bytes(std::string_view bytes) {
    bytes_.append(bytes);
    return *this;
  }
  McapFields& put_map(const McapMap& map);

  const std::string& bytes() const { return bytes_; }
  /// The whole record.
  std::string record(McapRecord kind) const;

 private:
  std::string bytes_;
};

/// Reads fields of a record. Throws Error where it ends before them; `where` is the text before
/// that error's.
class McapFieldReader {
 public:
  McapFieldReader(std::string_view fields, std::string where)
      : rest_(fields), where_(std::move(where)) {}

  template <class T>
  T get() {
    static_assert(std::is_unsigned_v<T>);
    std::array<char, sizeof(T)> raw{};
    take(raw.size()).copy(raw.data(), raw.size());
    return std::bit_cast<T>(raw);
  }
  std::string_view get_text() { return take(get<std::uint32_t>()); }
  McapMap get_map();
  std::string_view take(std::uint64_t size);
  std::string_view rest() const { return rest_; }

 private:
  std::string_view rest_;
  std::string where_;
};

}  // namespace vinebench::harness
