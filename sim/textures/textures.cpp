// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/textures/textures.h"

#include <array>
#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>
#include <utility>
#include <vector>

namespace vinebench::sim {

namespace {

/// Where and how much four neighbours count, for a row of interpolated values.
struct CubicTaps {
  std::vector<std::array<int, 4>> cells;
  std::vector<std::array<float, 4>> weights;
};

/// Of `size` values over `cells` cells that repeat: Keys' cubic with a = -0.75. Each step is in the
/// order and precision in which OpenCV's resize() takes it on an image with three cells more on
/// either side. That gives the same bytes, but computes the rims too.
CubicTaps cubic_taps(int size, int cells) {
  constexpr int kBeyond = 3;
  constexpr float kA = -0.75f;
  const double step = static_cast<double>(size) / cells;
  const int wrapped = cells + 2 * kBeyond;
  const double scale = 1 / (static_cast<double>(cvRound(wrapped * step)) / wrapped);
  const int first = cvRound(kBeyond * step);
  CubicTaps taps;
  for (int i = 0; i < size; ++i) {
    const auto at = static_cast<float>((first + i + 0.5) * scale - 0.5);
    const int cell = cvFloor(at);
    const float x = at - static_cast<float>(cell);
    const std::array<float, 3> w{((kA * (x + 1) - 5 * kA) * (x + 1) + 8 * kA) * (x + 1) - 4 * kA,
                                 ((kA + 2) * x - (kA + 3)) * x * x + 1,
                                 ((kA + 2) * (1 - x) - (kA + 3)) * (1 - x) * (1 - x) + 1};
    const auto wrap = [&](int c) { return (c - kBeyond + 3 * cells) % cells; };
    taps.cells.push_back({wrap(cell - 1), wrap(cell), wrap(cell + 1), wrap(cell + 2)});
    taps.weights.push_back({w[0], w[1], w[2], 1.0f - w[0] - w[1] - w[2]});
  }
  return taps;
}

/// Adds `height` times smooth noise in [0, 1], seamlessly tileable, with `cells` bumps per side.
void add_noise(cv::Mat& sum, cv::Size cells, const RandomStream& random, float height) {
  cv::Mat grid(cells, CV_32F);
  for (int y = 0; y < cells.height; ++y) {
    auto* row = grid.ptr<float>(y);
    for (int x = 0; x < cells.width; ++x) {
      row[x] = static_cast<float>(random.uniform(y * cells.width + x));
    }
  }
  if (cells == sum.size()) {
    for (int y = 0; y < sum.rows; ++y) {
      auto* to = sum.ptr<float>(y);
      const auto* from = grid.ptr<float>(y);
      for (int x = 0; x < sum.cols; ++x) to[x] = from[x] * height + to[x];
    }
    return;
  }
  const CubicTaps across = cubic_taps(sum.cols, cells.width);
  cv::Mat rows(cells.height, sum.cols, CV_32F);
  for (int y = 0; y < rows.rows; ++y) {
    const auto* from = grid.ptr<float>(y);
    auto* to = rows.ptr<float>(y);
    for (std::size_t x = 0; x < across.cells.size(); ++x) {
      const auto& [a, b, c, d] = across.cells[x];
      const auto& [wa, wb, wc, wd] = across.weights[x];
      to[x] = from[a] * wa + from[b] * wb + from[c] * wc + from[d] * wd;
    }
  }
  const CubicTaps down = cubic_taps(sum.rows, cells.height);
  for (int y = 0; y < sum.rows; ++y) {
    const auto& cell = down.cells[static_cast<std::size_t>(y)];
    const auto& [wa, wb, wc, wd] = down.weights[static_cast<std::size_t>(y)];
    const auto *a = rows.ptr<float>(cell[0]), *b = rows.ptr<float>(cell[1]);
    const auto *c = rows.ptr<float>(cell[2]), *d = rows.ptr<float>(cell[3]);
    auto* to = sum.ptr<float>(y);
    for (int x = 0; x < sum.cols; ++x) {
      to[x] = (a[x] * wa + (b[x] * wb + (c[x] * wc + d[x] * wd))) * height + to[x];
    }
  }
}

}  // namespace

cv::Mat fractal_noise(cv::Size size, cv::Size cells, int octaves, double gain, std::uint64_t seed,
                      std::string_view name) {
  cv::Mat sum = cv::Mat::zeros(size, CV_32F);
  double height = 1;
  for (int octave = 0; octave < octaves; ++octave) {
    if (cells.width > size.width || cells.height > size.height) break;
    add_noise(sum, cells, RandomStream(seed, name, octave), static_cast<float>(height));
    height *= gain;
    cells *= 2;
  }
  cv::normalize(sum, sum, 0, 1, cv::NORM_MINMAX);
  return sum;
}

cv::Mat blend(const cv::Mat& amount, const cv::Vec3f& low, const cv::Vec3f& high) {
  const cv::Vec3f way = high - low;
  cv::Mat out(amount.size(), CV_32FC3);
  for (int y = 0; y < amount.rows; ++y) {
    const auto* share = amount.ptr<float>(y);
    auto* to = out.ptr<float>(y);
    for (int x = 0; x < amount.cols; ++x) {
      for (int c = 0; c < 3; ++c) to[3 * x + c] = low[c] + way[c] * share[x];
    }
  }
  return out;
}

cv::Mat mix(const cv::Mat& amount, cv::Mat&& a, const cv::Mat& b) {
  for (int y = 0; y < amount.rows; ++y) {
    const auto* share = amount.ptr<float>(y);
    const auto* other = b.ptr<float>(y);
    auto* to = a.ptr<float>(y);
    for (int x = 0; x < amount.cols; ++x) {
      for (int c = 0; c < 3; ++c) to[3 * x + c] += (other[3 * x + c] - to[3 * x + c]) * share[x];
    }
  }
  return std::move(a);
}

cv::Mat mix(const cv::Mat& amount, const cv::Mat& a, const cv::Mat& b) {
  return mix(amount, a.clone(), b);
}

cv::Mat mix(const cv::Mat& amount, cv::Mat&& a, const cv::Vec3f& colour) {
  for (int y = 0; y < amount.rows; ++y) {
    const auto* share = amount.ptr<float>(y);
    auto* to = a.ptr<float>(y);
    for (int x = 0; x < amount.cols; ++x) {
      for (int c = 0; c < 3; ++c) to[3 * x + c] += (colour[c] - to[3 * x + c]) * share[x];
    }
  }
  return std::move(a);
}

cv::Mat to_rgba(const cv::Mat& rgb, const cv::Mat& alpha) {
  cv::Mat rgba(rgb.size(), CV_8UC4);
  for (int y = 0; y < rgb.rows; ++y) {
    const auto* from = rgb.ptr<float>(y);
    const auto* opacity = alpha.empty() ? nullptr : alpha.ptr<uchar>(y);
    auto* to = rgba.ptr<uchar>(y);
    for (int x = 0; x < rgb.cols; ++x) {
      for (int c = 0; c < 3; ++c) to[4 * x + c] = cv::saturate_cast<uchar>(from[3 * x + c]);
      to[4 * x + 3] = opacity == nullptr ? uchar{255} : opacity[x];
    }
  }
  return rgba;
}

}  // namespace vinebench::sim
