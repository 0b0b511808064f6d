// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace vinebench::harness {

static_assert(std::endian::native == std::endian::little, "CDR is written as little-endian");

/// The encapsulation of plain CDR, little-endian, and its bytes before the message.
inline constexpr std::string_view kCdrLittleEndian{"\x00\x01\x00\x00", 4};

/// A message in CDR, as ROS 2 has it in bags (OMG, DDS-XTYPES 7.4: plain CDR version 1): numbers
/// are aligned to their own size, counted from the byte after the encapsulation, and what is
/// between them is 0.
class CdrWriter {
 public:
  template <class T>
  void put(T value) {
    static_assert(std::is_arithmetic_v<T>);
    const std::size_t at = bytes_.size() - kCdrLittleEndian.size();
    bytes_.append((sizeof(T) - at % sizeof(T)) % sizeof(T), '\0');
    const auto raw = std::bit_cast<std::array<char, sizeof(T)>>(value);
    bytes_.append(raw.data(), raw.size());
  }
  /// A string: its length with the zero at the end.
  void put_text(std::string_view text) {
    put(static_cast<std::uint32_t>(text.size() + 1));
    bytes_.append(text);
    bytes_ += '\0';
  }
  /// A sequence of bytes.
  void put_bytes(std::string_view bytes) {
    put(static_cast<std::uint32_t>(bytes.size()));
    bytes_.append(bytes);
  }
  /// A sequence of numbers.
  void put_numbers(const std::vector<double>& numbers) {
    put(static_cast<std::uint32_t>(numbers.size()));
    for (const double number : numbers) put(number);
  }
  /// An array of fixed length.
  template <std::size_t N>
  void put_array(const std::array<double, N>& numbers) {
    for (const double number : numbers) put(number);
  }

  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_{kCdrLittleEndian};
};

}  // namespace vinebench::harness
