// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/render/gl/read_back.h"

#if defined(__SSE4_1__)
#include <smmintrin.h>
#endif

#include <algorithm>
#include <cstring>

#include "sim/render/gl/scene/frustum.h"

namespace vinebench::sim {
namespace {

constexpr int kStripRows = 32;

void split(const std::uint8_t* rgba, int count, std::uint8_t* rgb, std::uint8_t* alpha) {
  int x = 0;
#if defined(__SSE4_1__)
  const __m128i order = _mm_setr_epi8(0, 1, 2, 4, 5, 6, 8, 9, 10, 12, 13, 14, 3, 7, 11, 15);
  for (; x + 8 <= count; x += 4) {  // 16 bytes are stored, of which 12 are kept
    const __m128i pixels = _mm_loadu_si128(reinterpret_cast<const __m128i*>(rgba + 4 * x));
    const __m128i sorted = _mm_shuffle_epi8(pixels, order);
    _mm_storeu_si128(reinterpret_cast<__m128i*>(rgb + 3 * x), sorted);
    const int alphas = _mm_extract_epi32(sorted, 3);
    std::memcpy(alpha + x, &alphas, sizeof(alphas));
  }
#endif
  for (; x < count; ++x) {
    std::copy_n(rgba + 4 * x, 3, rgb + 3 * x);
    alpha[x] = rgba[4 * x + 3];
  }
}

float distance_of(float depth) {
  constexpr double kSpan = kFarPlane - kNearPlane;
  constexpr double kProduct = kFarPlane * kNearPlane;
  const auto z = static_cast<float>(kProduct / (kFarPlane - static_cast<double>(depth) * kSpan));
  return depth >= 1.0f ? 0.0f : z;
}

/// Bytes of the number (low, middle, high) and part to the number times 256 plus the part.
std::uint32_t instance_of(std::uint32_t bytes) {
  return bytes << 8 | bytes >> 24;
}

}  // namespace

template <class Take>
void ReadBack::rows(const GlFunctions& gl, const cv::Size& size, GLenum format, GLenum type,
                    std::size_t pixel, const Take& take) {
  const std::size_t row = static_cast<std::size_t>(size.width) * pixel;
  strip_.resize(std::max(strip_.size(), kStripRows * row));
  gl.PixelStorei(GL_PACK_ALIGNMENT, 4);
  for (int top = 0; top < size.height; top += kStripRows) {
    const int count = std::min(kStripRows, size.height - top);
    gl.ReadPixels(0, top, size.width, count, format, type, strip_.data());
    for (int y = 0; y < count; ++y)
      take(top + y, strip_.data() + static_cast<std::size_t>(y) * row);
  }
}

void ReadBack::colours(const GlFunctions& gl, const cv::Size& size, cv::Mat& rgb, cv::Mat& labels) {
  rgb.create(size, CV_8UC3);
  labels.create(size, CV_8UC1);
  gl.ReadBuffer(GL_COLOR_ATTACHMENT0);
  rows(gl, size, GL_RGBA, GL_UNSIGNED_BYTE, 4,
       [&](int y, const std::uint8_t* row) { split(row, size.width, rgb.ptr(y), labels.ptr(y)); });
}

void ReadBack::depth(const GlFunctions& gl, const cv::Size& size, cv::Mat& depth) {
  depth.create(size, CV_32FC1);
  rows(gl, size, GL_DEPTH_COMPONENT, GL_FLOAT, sizeof(float), [&](int y, const std::uint8_t* row) {
    const auto* from = reinterpret_cast<const float*>(row);
    std::transform(from, from + size.width, depth.ptr<float>(y), distance_of);
  });
}

void ReadBack::instances(const GlFunctions& gl, const cv::Size& size, cv::Mat& numbers) {
  numbers.create(size, CV_32SC1);
  gl.ReadBuffer(GL_COLOR_ATTACHMENT1);
  rows(gl, size, GL_RGBA, GL_UNSIGNED_BYTE, 4, [&](int y, const std::uint8_t* row) {
    const auto* from = reinterpret_cast<const std::uint32_t*>(row);
    std::transform(from, from + size.width, numbers.ptr<std::uint32_t>(y), instance_of);
  });
}

void ReadBack::normals(const GlFunctions& gl, const cv::Size& size, cv::Mat& normals) {
  constexpr float kStep = 2.0f / 65535;
  normals.create(size, CV_32FC3);
  gl.ReadBuffer(GL_COLOR_ATTACHMENT2);
  rows(gl, size, GL_RGBA, GL_UNSIGNED_SHORT, 4 * sizeof(std::uint16_t),
       [&](int y, const std::uint8_t* row) {
         const auto* from = reinterpret_cast<const std::uint16_t*>(row);
         auto* to = normals.ptr<float>(y);
         for (int x = 0; x < size.width; ++x) {
           const float drawn = from[4 * x + 3] != 0 ? 1.0f : 0.0f;
           for (int c = 0; c < 3; ++c) {
             to[3 * x + c] = kStep * static_cast<float>(from[4 * x + c]) - drawn;
           }
         }
       });
}

void ReadBack::motion(const GlFunctions& gl, const cv::Size& size, cv::Mat& motion) {
  motion.create(size, CV_32FC3);
  gl.ReadBuffer(GL_COLOR_ATTACHMENT3);
  rows(gl, size, GL_RGBA, GL_FLOAT, 4 * sizeof(float), [&](int y, const std::uint8_t* row) {
    const auto* from = reinterpret_cast<const float*>(row);
    auto* to = motion.ptr<float>(y);
    for (int x = 0; x < size.width; ++x) {
      for (int c = 0; c < 3; ++c) to[3 * x + c] = from[4 * x + c];
    }
  });
}

}  // namespace vinebench::sim
