// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "harness/datasets/ros2/cdr/encoded_message.h"

namespace vinebench::harness {

/// Reads a message in plain CDR, little- or big-endian, or as of ROS 1, value by value. The bytes
/// may be anything:
/// every length is held against what is left before memory is taken. Throws Error with the byte of
/// the message.
class CdrReader {
 public:
  /// Keeps a view of the bytes. Throws Error for another encapsulation than plain CDR's.
  explicit CdrReader(const EncodedMessage& message);

  MessageCoding coding() const { return coding_; }

  template <class T>
  T get() {
    static_assert(std::is_arithmetic_v<T>);
    std::array<char, sizeof(T)> raw{};
    const std::string_view bytes = take_aligned(sizeof(T));
    std::ranges::copy(bytes, raw.begin());
    if (swapped_) std::ranges::reverse(raw);
    return std::bit_cast<T>(raw);
  }
  std::string get_text();
  /// A sequence of bytes, a view of the message.
  std::string_view get_bytes();
  std::vector<double> get_numbers();
  template <std::size_t N>
  void get_array(std::array<double, N>& numbers) {
    for (double& number : numbers) number = get<double>();
  }
  /// The length of a sequence whose elements have at least that many bytes each.
  std::uint32_t get_length(std::size_t bytes_each);

 private:
  std::string_view take(std::size_t size);
  std::string_view take_aligned(std::size_t size);

  std::string_view message_;
  MessageCoding coding_;
  std::size_t at_ = 0;
  bool swapped_ = false;
};

}  // namespace vinebench::harness
