// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/files/png_writer.h"

#include <libdeflate.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <vector>

#include "core/util/error.h"
#include "harness/datasets/files/noise_deflate.h"
#include "harness/datasets/files/run_deflate.h"

namespace vinebench::harness {
namespace {

constexpr std::uint8_t kGrey = 0;  // colour types of PNG
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

/// PNG's filters: what the difference is taken to.
enum class Filter : std::uint8_t { kSub = 1, kUp = 2 };  // the pixel on the left, or above

/// By size, of the labels of a drive past vines: "Up" is better for 8 bits, "Sub" for depths.
Filter filter_for(const cv::Mat& image, PngContent content) {
  return content == PngContent::kAreas && image.elemSize1() == 1 ? Filter::kUp : Filter::kSub;
}

/// `above` is the row before, or null.
void filter_row(const std::uint8_t* from, const std::uint8_t* above, std::size_t size,
                std::size_t pixel, Filter filter, std::uint8_t* to) {
  if (filter == Filter::kUp && above == nullptr) {
    std::memcpy(to, from, size);
  } else if (filter == Filter::kUp) {
    for (std::size_t i = 0; i < size; ++i) to[i] = static_cast<std::uint8_t>(from[i] - above[i]);
  } else {
    std::memcpy(to, from, std::min(pixel, size));
    for (std::size_t i = pixel; i < size; ++i) {
      to[i] = static_cast<std::uint8_t>(from[i] - from[i - pixel]);
    }
  }
}

/// The filtered rows, each after its filter's number; valid until the thread's next call. The
/// buffer is reused, because fresh pages cost as much as the filter.
const std::vector<std::uint8_t>& filtered(const cv::Mat& image, PngContent content) {
  const Filter filter = filter_for(image, content);
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
    *to++ = static_cast<std::uint8_t>(filter);
    filter_row(wide ? plain.data() : image.ptr(y), y == 0 ? nullptr : image.ptr(y - 1), row, pixel,
               filter, to);
    to += row;
  }
  return bytes;
}

/// Also valid until the thread's next call.
std::string_view compressed(const std::vector<std::uint8_t>& bytes, PngContent content) {
  thread_local std::vector<char> buffer;
  return content == PngContent::kNoise ? deflate_noise(bytes, buffer) : deflate_runs(bytes, buffer);
}

}  // namespace

std::string encode_png(const cv::Mat& image, PngContent content) {
  static_assert(std::endian::native == std::endian::little, "rows of 16 bits are byte-swapped");
  const bool known = (image.depth() == CV_8U || image.depth() == CV_16U) &&
                     (image.channels() == 1 || image.channels() == 3);
  if (!known || image.empty()) fail("PNG: expected an image of 8 or 16 bits, grey or RGB");
  std::string bytes(kSignature);
  const std::string_view data = compressed(filtered(image, content), content);
  bytes.reserve(data.size() + 256);  // with the other chunks
  append_chunk(bytes, "IHDR", header(image));
  append_chunk(bytes, "IDAT", data);
  append_chunk(bytes, "IEND", "");
  return bytes;
}

}  // namespace vinebench::harness
