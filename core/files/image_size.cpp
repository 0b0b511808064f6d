// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/files/image_size.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "core/util/error.h"

namespace vinebench {
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

/// Lossy, lossless or extended.
std::optional<cv::Size2d> webp_size(std::string_view bytes) {
  const Numbers numbers(bytes, true);
  const std::string_view kind = bytes.substr(std::min<std::size_t>(12, bytes.size()), 4);
  if (kind == "VP8 ") return cv::Size2d(numbers.at(26, 2) & 0x3fff, numbers.at(28, 2) & 0x3fff);
  if (kind == "VP8X") return cv::Size2d(numbers.at(24, 3) + 1.0, numbers.at(27, 3) + 1.0);
  if (kind != "VP8L") return std::nullopt;
  const std::uint32_t sides = numbers.at(21, 4);
  return cv::Size2d((sides & 0x3fff) + 1.0, (sides >> 14 & 0x3fff) + 1.0);
}

/// A negative height means that the first row is on top.
std::optional<cv::Size2d> bmp_size(std::string_view bytes) {
  const Numbers numbers(bytes, true);
  if (numbers.at(14, 4) == 12) return cv::Size2d(numbers.at(18, 2), numbers.at(20, 2));
  const double height = static_cast<std::int32_t>(numbers.at(22, 4));
  return cv::Size2d(static_cast<std::int32_t>(numbers.at(18, 4)), std::abs(height));
}

/// Decimal numbers after the two letters, with comments from # to the end of a line.
std::optional<cv::Size2d> netpbm_size(std::string_view bytes) {
  constexpr std::string_view kDigits = "0123456789";
  std::array<double, 2> size{};
  std::size_t at = 2;
  for (double& side : size) {
    for (; at < bytes.size() && kDigits.find(bytes[at]) == kDigits.npos; ++at) {
      if (bytes[at] == '#') at = std::min(bytes.find('\n', at), bytes.size() - 1);
    }
    if (at >= bytes.size()) return std::nullopt;
    for (; at < bytes.size() && kDigits.find(bytes[at]) != kDigits.npos; ++at) {
      side = 10 * side + (bytes[at] - '0');
    }
  }
  return cv::Size2d(size[0], size[1]);
}

}  // namespace

void check_image_size(std::string_view bytes, const std::string& where) {
  const std::optional<cv::Size2d> size = image_size(bytes);
  if (!size) fail("{}: expected an image (PNG, JPEG, TIFF, WebP, BMP or PNM)", where);
  if (size->width >= 1 && size->height >= 1 && size->area() <= kMostPixels) return;
  fail("{}: expected an image of at most {} pixels, found {} x {}", where, kMostPixels, size->width,
       size->height);
}

std::optional<cv::Size2d> image_size(std::string_view bytes) {
  if (bytes.starts_with("\x89PNG\r\n\x1a\n"sv)) return png_size(bytes);
  if (bytes.starts_with("\xff\xd8"sv)) return jpeg_size(bytes);
  if (bytes.starts_with("II*\0"sv) || bytes.starts_with("MM\0*"sv)) return tiff_size(bytes);
  if (bytes.starts_with("RIFF"sv) && bytes.substr(0, 12).ends_with("WEBP"sv)) {
    return webp_size(bytes);
  }
  if (bytes.starts_with("BM"sv)) return bmp_size(bytes);
  if (bytes.size() > 2 && bytes[0] == 'P' && bytes[1] >= '1' && bytes[1] <= '6') {
    return netpbm_size(bytes);
  }
  return std::nullopt;
}

}  // namespace vinebench
