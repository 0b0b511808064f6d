// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/files/image_codec.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "core/util/error.h"

namespace vinebench::harness {
namespace {

static_assert(std::endian::native == std::endian::little, ".npy and .flo are little-endian here");

constexpr float kFloUnknown = 1e10f;
constexpr int kJpegQuality = 95;
constexpr int kWebpLossless = 101;  // OpenCV: a quality above 100

std::string encode(const char* ending, const cv::Mat& image, const std::vector<int>& options) {
  cv::Mat bgr;  // a copy: the image may be shared
  if (image.channels() == 3) cv::cvtColor(image, bgr, cv::COLOR_RGB2BGR);
  std::vector<unsigned char> bytes;
  if (!cv::imencode(ending, bgr.empty() ? image : bgr, bytes, options)) {
    fail("an image cannot be encoded as {}", ending);
  }
  return {bytes.begin(), bytes.end()};
}

template <class T>
void append(std::string& bytes, T value) {
  const auto raw = std::bit_cast<std::array<char, sizeof(T)>>(value);
  bytes.append(raw.data(), raw.size());
}

}  // namespace

std::string encode_image(const cv::Mat& image, ImageKind kind) {
  switch (kind) {
    case ImageKind::kJpeg:
      return encode(".jpg", image, {cv::IMWRITE_JPEG_QUALITY, kJpegQuality});
    case ImageKind::kWebp:
      return encode(".webp", image, {cv::IMWRITE_WEBP_QUALITY, kWebpLossless});
    case ImageKind::kPng:
      break;
  }
  return encode_png(image, PngContent::kNoise);
}

cv::Mat to_grey(const cv::Mat& image) {
  if (image.channels() == 1) return image;
  cv::Mat grey;
  cv::cvtColor(image, grey, cv::COLOR_RGB2GRAY);
  return grey;
}

std::string encode_npy(const cv::Mat& image) {
  if (image.depth() != CV_32F) fail("encode_npy: expected an image of floats");
  constexpr std::size_t kPreamble = 10;   // magic, version, length of the header
  constexpr std::size_t kAlignment = 64;  // of the data
  const std::string channels = image.channels() == 1 ? "" : fmt::format(", {}", image.channels());
  std::string header =
      fmt::format("{{'descr': '<f4', 'fortran_order': False, 'shape': ({}, {}{}), }}", image.rows,
                  image.cols, channels);
  header.append(kAlignment - 1 - (kPreamble + header.size()) % kAlignment, ' ');
  header += '\n';
  std::string bytes("\x93NUMPY\x01\x00", 8);
  append(bytes, static_cast<std::uint16_t>(header.size()));
  bytes += header;
  for (int y = 0; y < image.rows; ++y) {
    bytes.append(image.ptr<char>(y), static_cast<std::size_t>(image.cols) * image.elemSize());
  }
  return bytes;
}

bool has_flow(const cv::Vec2f& flow) {
  return std::isfinite(flow[0]) && std::isfinite(flow[1]);
}

/// Format of Baker et al., "A Database and Evaluation Methodology for Optical Flow" (2011).
std::string encode_flo(const cv::Mat& flow) {
  std::string bytes = "PIEH";
  bytes.reserve(12 + flow.total() * flow.elemSize());
  append(bytes, static_cast<std::int32_t>(flow.cols));
  append(bytes, static_cast<std::int32_t>(flow.rows));
  for (int y = 0; y < flow.rows; ++y) {
    for (int x = 0; x < flow.cols; ++x) {
      const auto& f = flow.at<cv::Vec2f>(y, x);
      append(bytes, has_flow(f) ? f[0] : kFloUnknown);
      append(bytes, has_flow(f) ? f[1] : kFloUnknown);
    }
  }
  return bytes;
}

}  // namespace vinebench::harness
