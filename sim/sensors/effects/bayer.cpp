// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/sensors/effects/bayer.h"

#include <array>
#include <opencv2/imgproc.hpp>

#include "core/util/error.h"

namespace vinebench::sim {
namespace {

/// Channel of each filter of the square of two by two.
std::array<int, 4> filters(BayerPattern pattern) {
  switch (pattern) {
    case BayerPattern::kRggb:
      return {0, 1, 1, 2};
    case BayerPattern::kGrbg:
      return {1, 0, 2, 1};
    case BayerPattern::kGbrg:
      return {1, 2, 0, 1};
    case BayerPattern::kBggr:
      return {2, 1, 1, 0};
    case BayerPattern::kNone:
      break;
  }
  fail("bayer: expected a pattern of colour filters");
}

/// OpenCV names a pattern for its second row's second and third filter.
int conversion(BayerPattern pattern) {
  switch (pattern) {
    case BayerPattern::kGrbg:
      return cv::COLOR_BayerGB2RGB_EA;
    case BayerPattern::kGbrg:
      return cv::COLOR_BayerGR2RGB_EA;
    case BayerPattern::kBggr:
      return cv::COLOR_BayerRG2RGB_EA;
    default:
      return cv::COLOR_BayerBG2RGB_EA;
  }
}

class ColourFilters : public CodeEffect {
 public:
  explicit ColourFilters(BayerPattern pattern) : pattern_(pattern) {}
  void apply(cv::Mat& codes, const Shot&) override { codes = mosaic(codes, pattern_); }

 private:
  BayerPattern pattern_;
};

class ColourInterpolation : public CodeEffect {
 public:
  explicit ColourInterpolation(BayerPattern pattern) : pattern_(pattern) {}
  void apply(cv::Mat& codes, const Shot&) override { codes = demosaic(codes, pattern_); }

 private:
  BayerPattern pattern_;
};

template <class Effect>
std::unique_ptr<CodeEffect> unless_off(BayerPattern pattern) {
  if (pattern == BayerPattern::kNone) return nullptr;
  return std::make_unique<Effect>(pattern);
}

}  // namespace

cv::Mat mosaic(const cv::Mat& rgb, BayerPattern pattern) {
  const std::array<int, 4> channel = filters(pattern);
  cv::Mat sites(rgb.size(), CV_8UC1);
  for (int y = 0; y < rgb.rows; ++y) {
    const auto* from = rgb.ptr<cv::Vec3b>(y);
    auto* to = sites.ptr<std::uint8_t>(y);
    const std::size_t row = 2 * static_cast<std::size_t>(y % 2);
    for (int x = 0; x < rgb.cols; ++x)
      to[x] = from[x][channel[row + static_cast<std::size_t>(x % 2)]];
  }
  return sites;
}

cv::Mat demosaic(const cv::Mat& mosaic, BayerPattern pattern) {
  cv::Mat rgb;
  cv::demosaicing(mosaic, rgb, conversion(pattern), 3);
  return rgb;
}

std::unique_ptr<CodeEffect> make_colour_filters(BayerPattern pattern) {
  return unless_off<ColourFilters>(pattern);
}

std::unique_ptr<CodeEffect> make_colour_interpolation(BayerPattern pattern) {
  return unless_off<ColourInterpolation>(pattern);
}

}  // namespace vinebench::sim
