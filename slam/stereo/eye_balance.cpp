// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/stereo/eye_balance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>

#include "slam/stereo/match_sample.h"

namespace vinebench::slam {
namespace {

/// Eyes that agree so far are left alone: the search does not mind.
constexpr double kAlike = 0.05;

/// No more is believed: a camera that sees next to nothing is not to be brightened to noise.
constexpr double kMaxGain = 4;

constexpr int kSaturated = 250;  // grey levels; a lens and a pyramid soften the very limit
constexpr double kDark = 8;      // grey levels; below, the black level counts more than the gain

/// Fewer features found than this share of them ask for an explanation.
constexpr int kMinFeatures = 50;
constexpr double kFewShare = 0.3;

/// A gain is borne out by this many times the matches.
constexpr std::size_t kBearsOut = 2;
constexpr std::size_t kMinMatches = 25;

constexpr std::size_t kWindows = 200;  ///< measured of a frame, up to twice as many
constexpr int kRadius = 5;             // px, of a window

using Histogram = std::array<int, 256>;

Histogram histogram_of(const cv::Mat& image) {
  Histogram histogram{};
  for (int row = 0; row < image.rows; ++row) {
    const auto* grey = image.ptr<std::uint8_t>(row);
    for (int column = 0; column < image.cols; ++column) ++histogram[grey[column]];
  }
  return histogram;
}

/// Grey level that this share of the image does not exceed.
int quantile(const Histogram& histogram, std::ptrdiff_t pixels, double share) {
  const double wanted = share * static_cast<double>(pixels);
  std::ptrdiff_t below = 0;
  int level = 0;
  while (level < 255 &&
         static_cast<double>(below += histogram[static_cast<std::size_t>(level)]) < wanted) {
    ++level;
  }
  return level;
}

/// Sum of a window's grey levels; none where it leaves the image or is saturated somewhere.
std::optional<int> sum_of_window(const cv::Mat& image, int x, int y, double saturated) {
  if (x < kRadius || y < kRadius || x >= image.cols - kRadius || y >= image.rows - kRadius) {
    return std::nullopt;
  }
  int sum = 0;
  int brightest = 0;
  for (int row = y - kRadius; row <= y + kRadius; ++row) {
    const auto* grey = image.ptr<std::uint8_t>(row) + x;
    for (int column = -kRadius; column <= kRadius; ++column) {
      sum += grey[column];
      brightest = std::max<int>(brightest, grey[column]);
    }
  }
  if (brightest >= saturated) return std::nullopt;
  return sum;
}

}  // namespace

cv::Mat EyeBalance::balanced(const cv::Mat& right, double gain) {
  if (gain == 1) return right;
  cv::Mat table(1, 256, CV_8UC1);
  for (int level = 0; level < 256; ++level) {
    table.at<std::uint8_t>(level) =
        static_cast<std::uint8_t>(std::min(255L, std::lround(gain * level)));
  }
  cv::Mat result;
  cv::LUT(right, table, result);
  return result;
}

std::optional<double> EyeBalance::suspect(const cv::Mat& left, const cv::Mat& right,
                                          const std::vector<StereoMatch>& matches) const {
  const auto features = static_cast<int>(matches.size());
  if (features < kMinFeatures ||
      static_cast<double>(count_found(matches)) >= kFewShare * features) {
    return std::nullopt;
  }
  const Histogram of_left = histogram_of(left);
  const Histogram of_right = histogram_of(right);
  const auto pixels = static_cast<std::ptrdiff_t>(left.total());
  int sum_left = 0;
  int sum_right = 0;
  for (const double share : {0.1, 0.3, 0.5, 0.7, 0.9}) {
    const int a = quantile(of_left, pixels, share);
    const int b = quantile(of_right, pixels, share);
    if (std::max(a, b) >= kSaturated || std::min(a, b) < kDark) continue;
    sum_left += a;
    sum_right += b;
  }
  if (sum_right == 0) return std::nullopt;
  const double suspected = static_cast<double>(sum_left) / sum_right;
  const bool new_to_us = std::abs(suspected / gain_ - 1) > kAlike;
  if (!new_to_us || suspected > kMaxGain || suspected < 1 / kMaxGain) return std::nullopt;
  return suspected;
}

bool EyeBalance::believe(double gain, const std::vector<StereoMatch>& without,
                         const std::vector<StereoMatch>& with) {
  const std::size_t found = count_found(with);
  if (found < kMinMatches || found < kBearsOut * count_found(without)) return false;
  gain_ = gain;
  return true;
}

void EyeBalance::measure(const Extraction& left, const std::vector<cv::Mat>& right,
                         const std::vector<StereoMatch>& matches, const OrbExtractor& extractor) {
  const double saturated_right = std::min<double>(kSaturated, gain_ * kSaturated);
  std::vector<double> ratios;
  for (const std::size_t i : sample_found(matches, kWindows)) {
    const Keypoint& keypoint = left.features.keypoints[i];
    const auto level = static_cast<std::size_t>(keypoint.level);
    const double pixel = extractor.scale_of(keypoint.level);
    const auto on_level = [pixel](float v) {
      return static_cast<int>(std::lround(to_level(static_cast<double>(v), pixel)));
    };
    const int y = on_level(keypoint.y);
    const auto a = sum_of_window(left.pyramid[level], on_level(keypoint.x), y, kSaturated);
    const auto b = sum_of_window(right[level], on_level(matches[i].x_right), y, saturated_right);
    constexpr int kArea = (2 * kRadius + 1) * (2 * kRadius + 1);
    if (!a || !b || std::min(*a, *b) < kDark * kArea) continue;
    ratios.push_back(static_cast<double>(*a) / *b);
  }
  if (ratios.size() < kMinMatches) return;
  const auto middle = ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2);
  std::ranges::nth_element(ratios, middle);
  const double gain = std::clamp(gain_ * *middle, 1 / kMaxGain, kMaxGain);
  gain_ = std::abs(gain - 1) > kAlike ? gain : 1;
}

}  // namespace vinebench::slam
