// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/assets/image_size.h"

#include <cstdint>

namespace vinebench::sim {
namespace {

using std::string_view_literals::operator""sv;

/// Integers of a file, zero beyond its end.
class Numbers {
 public:
  Numbers(std::string_view bytes, bool little_endian)
      : bytes_(bytes), little_endian_(little_endian) {}

  std::uint32_t at(std::size_t place, std::size_t size) const {
    if (place > bytes_.size() || size > bytes_.size() - place) return 0;
    std::uint32_t number = 0;
    for (std::size_t i = 0; i < size; ++i) {
      const std::size_t next = little_endian_ ? size - 1 - i : i;
      number = number << 8 | static_cast<std::uint8_t>(bytes_[place + next]);
    }
    return number;
  }

 private:
  std::string_view bytes_;
  bool little_endian_;
};

std::optional<cv::Size2d> png_size(std::string_view bytes) {
  const Numbers numbers(bytes, false);
  return cv::Size2d(numbers.at(16, 4), numbers.at(20, 4));
}

/// Skips segments up to the start of a frame.
std::optional<cv::Size2d> jpeg_size(std::string_view bytes) {
  const Numbers numbers(bytes, false);
  for (std::size_t at = 2; at + 9 <= bytes.size();) {
    if (numbers.at(at, 1) != 0xff) return std::nullopt;
    const std::uint32_t marker = numbers.at(at + 1, 1);
    if (marker == 0xff) {  // a fill byte
      ++at;
      continue;
    }
    const bool table = marker == 0xc4 || marker == 0xc8 || marker == 0xcc;
    if (marker >= 0xc0 && marker <= 0xcf && !table) {
      return cv::Size2d(numbers.at(at + 7, 2), numbers.at(at + 5, 2));
    }
    at += 2 + numbers.at(at + 2, 2);
  }
  return std::nullopt;
}

/// From the first directory's entries 256 and 257, each of 2 or 4 bytes.
std::optional<cv::Size2d> tiff_size(std::string_view bytes) {
  const Numbers numbers(bytes, bytes[0] == 'I');
  const std::size_t directory = numbers.at(4, 4);
  const std::uint32_t entries = numbers.at(directory, 2);
  cv::Size2d size;
  for (std::uint32_t i = 0; i < entries; ++i) {
    const std::size_t entry = directory + 2 + 12 * std::size_t{i};
    const std::uint32_t tag = numbers.at(entry, 2);
    const double value = numbers.at(entry + 8, numbers.at(entry + 2, 2) == 3 ? 2 : 4);
    if (tag == 256) size.width = value;
    if (tag == 257) size.height = value;
  }
  return size;
}

}  // namespace

std::optional<cv::Size2d> image_size(std::string_view bytes) {
  if (bytes.starts_with("\x89PNG\r\n\x1a\n"sv)) return png_size(bytes);
  if (bytes.starts_with("\xff\xd8"sv)) return jpeg_size(bytes);
  if (bytes.starts_with("II*\0"sv) || bytes.starts_with("MM\0*"sv)) return tiff_size(bytes);
  return std::nullopt;
}

}  // namespace vinebench::sim
