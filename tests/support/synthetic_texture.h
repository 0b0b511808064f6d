// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <opencv2/core/mat.hpp>

#include "core/util/random.h"

namespace vinebench::test {

/// A texture as a function of the plane: noise of several scales, with a steep response curve so
/// that it has edges like leaves and bark. Defined at every real coordinate, so a shifted, rotated
/// or scaled image of it is exact.
class SyntheticTexture {
 public:
  explicit SyntheticTexture(std::uint64_t seed) : seed_(seed) {}

  /// Grey level in (40, 215).
  double operator()(double x, double y) const {
    double sum = 0;
    double amplitude = 1;
    double cell = 40;
    for (std::uint64_t octave = 0; octave < 5; ++octave) {
      sum += amplitude * noise(x / cell, y / cell, octave);
      amplitude *= 0.7;
      cell *= 0.55;
    }
    return 127.5 + 87.5 * std::tanh(2.0 * sum);
  }

 private:
  /// Smooth noise in [-1, 1] over a unit lattice.
  double noise(double x, double y, std::uint64_t octave) const {
    const double fx = std::floor(x);
    const double fy = std::floor(y);
    const double sx = smooth(x - fx);
    const double sy = smooth(y - fy);
    const auto ix = static_cast<std::int64_t>(fx);
    const auto iy = static_cast<std::int64_t>(fy);
    const double top = (1 - sx) * lattice(ix, iy, octave) + sx * lattice(ix + 1, iy, octave);
    const double low =
        (1 - sx) * lattice(ix, iy + 1, octave) + sx * lattice(ix + 1, iy + 1, octave);
    return (1 - sy) * top + sy * low;
  }
  static double smooth(double f) { return f * f * f * (f * (6 * f - 15) + 10); }
  double lattice(std::int64_t x, std::int64_t y, std::uint64_t octave) const {
    std::uint64_t h = seed_ * 0x9e3779b97f4a7c15ULL + octave;
    h = (h ^ static_cast<std::uint64_t>(x)) * 0xbf58476d1ce4e5b9ULL;
    h = (h ^ (h >> 29) ^ static_cast<std::uint64_t>(y)) * 0x94d049bb133111ebULL;
    h ^= h >> 32;
    return static_cast<double>(h & 0xffffU) / 32767.5 - 1;
  }

  std::uint64_t seed_;
};

/// An image whose pixels are means of 3 x 3 samples of grey(x, y), plus Gaussian noise.
template <class Grey>
cv::Mat render_image(int width, int height, const Grey& grey, double sigma = 0,
                     std::uint64_t seed = 0) {
  const RandomStream noise(seed, "picture-noise");
  cv::Mat image(height, width, CV_8UC1);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      double sum = 0;
      for (int sy = -1; sy <= 1; ++sy) {
        for (int sx = -1; sx <= 1; ++sx) sum += grey(x + sx / 3.0, y + sy / 3.0);
      }
      const auto index = static_cast<std::uint64_t>(y * width + x);
      const double value = sum / 9 + (sigma > 0 ? sigma * noise.normal(index) : 0);
      image.at<std::uint8_t>(y, x) = cv::saturate_cast<std::uint8_t>(value);
    }
  }
  return image;
}

}  // namespace vinebench::test
