// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/files/png_writer.h"

#include <libdeflate.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string_view>
#include <vector>

#include "core/util/error.h"
#include "harness/datasets/files/noise_deflate.h"

namespace vinebench::harness {
namespace {

constexpr int kLevel = 1;               // libdeflate's fastest that compresses
constexpr std::uint8_t kSubFilter = 1;  // difference to the left pixel
constexpr std::uint8_t kGrey = 0;       // colour types of PNG
constexpr std::uint8_t kRgb = 2;
constexpr std::string_view kSignature("\x89PNG\r\n\x1a\n", 8);

/// PNG is big-endian.
void append(std::string& bytes, std::uint32_t value) {
  for (const int shift : {24, 16, 8, 0}) bytes += static_cast<char>(value >> shift & 0xff);
}

void append_chunk(std::string& bytes, std::string_view type, std::string_view content) {
  append(bytes, static_cast<std::uint32_t>(content.size()));
  bytes += type;
  bytes += content;
  const std::size_t checked = type.size() + content.size();
  append(bytes, libdeflate_crc32(0, bytes.data() + bytes.size() - checked, checked));
}

std::string header(const cv::Mat& image) {
  std::string content;
  append(content, static_cast<std::uint32_t>(image.cols));
  append(content, static_cast<std::uint32_t>(image.rows));
  content += static_cast<char>(8 * image.elemSize1());
  content += static_cast<char>(image.channels() == 1 ? kGrey : kRgb);
  content.append(3, '\0');  // deflate, the five usual filters, no interlacing
  return content;
}

void swap_bytes(const std::uint8_t* from, std::size_t size, std::uint8_t* to) {
  for (std::size_t i = 0; i < size; i += 2) {
    to[i] = from[i + 1];
    to[i + 1] = from[i];
  }
}

/// The first pixel, and the difference of each other to the one on its left.
void filter_row(const std::uint8_t* from, std::size_t size, std::size_t pixel, std::uint8_t* to) {
  std::memcpy(to, from, std::min(pixel, size));
  for (std::size_t i = pixel; i < size; ++i) {
    to[i] = static_cast<std::uint8_t>(from[i] - from[i - pixel]);
  }
}

/// The filtered rows, each after its filter number; valid until the thread's next call. The buffer
/// is reused, because fresh pages cost as much as the filter.
const std::vector<std::uint8_t>& filtered(const cv::Mat& image) {
  const std::size_t pixel = image.elemSize();
  const std::size_t row = static_cast<std::size_t>(image.cols) * pixel;
  const bool wide = image.elemSize1() == 2;
  thread_local std::vector<std::uint8_t> bytes;
  thread_local std::vector<std::uint8_t> plain;
  bytes.resize((row + 1) * static_cast<std::size_t>(image.rows));
  if (wide) plain.resize(row);
  std::uint8_t* to = bytes.data();
  for (int y = 0; y < image.rows; ++y) {
    if (wide) swap_bytes(image.ptr(y), row, plain.data());
    *to++ = kSubFilter;
    filter_row(wide ? plain.data() : image.ptr(y), row, pixel, to);
    to += row;
  }
  return bytes;
}

/// Also valid until the thread's next call.
std::string_view compressed(const std::vector<std::uint8_t>& bytes, PngRows rows) {
  if (rows == PngRows::kCodes) {
    thread_local std::vector<char> buffer;
    return deflate_noise(bytes, buffer);
  }
  const std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> compressor(
      libdeflate_alloc_compressor(kLevel), libdeflate_free_compressor);
  if (!compressor) fail("an image cannot be compressed: not enough memory");
  thread_local std::vector<char> result;
  result.resize(
      std::max(result.size(), libdeflate_zlib_compress_bound(compressor.get(), bytes.size())));
  return {result.data(), libdeflate_zlib_compress(compressor.get(), bytes.data(), bytes.size(),
                                                  result.data(), result.size())};
}

}  // namespace

std::string encode_png(const cv::Mat& image, PngRows rows) {
  static_assert(std::endian::native == std::endian::little, "rows of 16 bits are byte-swapped");
  const bool known = (image.depth() == CV_8U || image.depth() == CV_16U) &&
                     (image.channels() == 1 || image.channels() == 3);
  if (!known || image.empty()) fail("PNG: expected an image of 8 or 16 bits, grey or RGB");
  std::string bytes(kSignature);
  const std::string_view data = compressed(filtered(image), rows);
  bytes.reserve(data.size() + 256);  // with the other chunks
  append_chunk(bytes, "IHDR", header(image));
  append_chunk(bytes, "IDAT", data);
  append_chunk(bytes, "IEND", "");
  return bytes;
}

}  // namespace vinebench::harness
