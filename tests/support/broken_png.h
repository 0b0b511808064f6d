// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

namespace vinebench::test {

/// CRC of PNG's chunks (ISO/IEC 15948, annex D).
inline std::uint32_t png_crc(std::string_view bytes) {
  std::uint32_t crc = 0xffffffff;
  for (const char byte : bytes) {
    crc ^= static_cast<std::uint8_t>(byte);
    for (int bit = 0; bit < 8; ++bit) crc = (crc & 1) != 0 ? 0xedb88320 ^ (crc >> 1) : crc >> 1;
  }
  return ~crc;
}

/// A PNG of eight grey pixels whose header, with a valid checksum, states another size.
inline std::string png_of_size(std::uint32_t width, std::uint32_t height) {
  std::vector<unsigned char> encoded;
  cv::imencode(".png", cv::Mat(2, 4, CV_8UC1, cv::Scalar(9)), encoded);
  std::string bytes(encoded.begin(), encoded.end());
  const auto put = [&](std::size_t at, std::uint32_t value) {
    for (int i = 0; i < 4; ++i) {
      bytes[at + static_cast<std::size_t>(i)] = static_cast<char>(value >> (24 - 8 * i));
    }
  };
  put(16, width);
  put(20, height);
  put(29, png_crc(std::string_view(bytes).substr(12, 17)));  // the chunk's type and data
  return bytes;
}

}  // namespace vinebench::test
