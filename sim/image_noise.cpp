// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/image_noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "slam/base/error.h"
#include "slam/base/random.h"

namespace vinebench {
namespace {

constexpr int kTableBits = 12;
constexpr int kTableSize = 1 << kTableBits;
constexpr int kDrawsPerHash = 5;  // of 12 bits each

/// Inverse of the standard normal's distribution function: bisection on erfc, exact to 1e-12.
double normal_quantile(double p) {
  double low = -10;
  double high = 10;
  for (int i = 0; i < 50; ++i) {
    const double middle = 0.5 * (low + high);
    (0.5 * std::erfc(-middle / std::sqrt(2.0)) < p ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// Normal draws of that many equally likely classes, scaled to a variance of exactly one.
std::array<float, kTableSize> make_normal_table() {
  std::array<double, kTableSize> quantiles{};
  double sum_of_squares = 0;
  for (int i = 0; i < kTableSize; ++i) {
    quantiles[static_cast<std::size_t>(i)] = normal_quantile((i + 0.5) / kTableSize);
    sum_of_squares +=
        quantiles[static_cast<std::size_t>(i)] * quantiles[static_cast<std::size_t>(i)];
  }
  const double scale = std::sqrt(kTableSize / sum_of_squares);
  std::array<float, kTableSize> table{};
  for (std::size_t i = 0; i < table.size(); ++i)
    table[i] = static_cast<float>(scale * quantiles[i]);
  return table;
}

/// The same draws in sixteenths of a grey level.
std::array<std::int16_t, kTableSize> scaled_table(double sigma) {
  static const std::array<float, kTableSize> normal = make_normal_table();
  std::array<std::int16_t, kTableSize> table{};
  for (std::size_t i = 0; i < table.size(); ++i) {
    table[i] = static_cast<std::int16_t>(std::lround(16 * sigma * static_cast<double>(normal[i])));
  }
  return table;
}

/// Adds sixteenths of a grey level, rounds and saturates.
std::uint8_t noisy(std::uint8_t value, std::int16_t noise) {
  const int level = (16 * value + noise + 8) >> 4;
  return static_cast<std::uint8_t>(std::clamp(level, 0, 255));
}

}  // namespace

void add_image_noise(cv::Mat& image, const ImageNoiseConfig& config, std::uint64_t seed, int camera,
                     std::int64_t frame) {
  if (image.depth() != CV_8U || (image.channels() != 1 && image.channels() != 3)) {
    fail("image noise: expected a picture of one or three channels of 8 bits");
  }
  if (config.sigma <= 0) return;
  const std::array<std::int16_t, kTableSize> table = scaled_table(config.sigma);
  const RandomStream stream(seed, "image_noise." + std::to_string(camera),
                            static_cast<std::uint64_t>(frame));
  const int values = image.cols * image.channels();
  const auto hashes_per_row =
      static_cast<std::uint64_t>((values + kDrawsPerHash - 1) / kDrawsPerHash);
  for (int y = 0; y < image.rows; ++y) {
    auto* row = image.ptr<std::uint8_t>(y);
    std::uint64_t index = static_cast<std::uint64_t>(y) * hashes_per_row;
    for (int x = 0; x < values; x += kDrawsPerHash) {
      std::uint64_t bits = stream.bits(index++);
      const int end = std::min(values, x + kDrawsPerHash);
      for (int i = x; i < end; ++i, bits >>= kTableBits) {
        row[i] = noisy(row[i], table[bits & (kTableSize - 1)]);
      }
    }
  }
}

}  // namespace vinebench
