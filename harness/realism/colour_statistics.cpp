// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/util/percentile.h"
#include "harness/realism/picture_statistics.h"

namespace vinebench::harness {
namespace {

constexpr float kGreener = 0.08F;          // excess green of vegetation
constexpr double kLeastVegetation = 0.02;  // share of a picture that has any

double mean_of(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

double deviation_of(const std::vector<double>& values) {
  const double mean = mean_of(values);
  double sum = 0;
  for (const double value : values) sum += (value - mean) * (value - mean);
  return std::sqrt(sum / static_cast<double>(values.size()));
}

/// (2 G - R - B) / (R + G + B).
float excess_green(const cv::Vec3b& rgb) {
  const float red = rgb[0], green = rgb[1], blue = rgb[2];
  return (2 * green - red - blue) / (red + green + blue + 1);
}

struct Vegetation {
  std::vector<double> hue;  ///< degrees
  std::vector<double> saturation;
  std::vector<double> value;
};

}  // namespace

void add_colour_statistics(const cv::Mat& rgb, const cv::Mat& grey, PictureStatistics& statistics) {
  cv::Mat hsv;
  cv::cvtColor(rgb, hsv, cv::COLOR_RGB2HSV);
  std::vector<double> saturation;
  Vegetation vegetation;
  double excess_sum = 0;
  for (int y = 0; y < rgb.rows; ++y) {
    for (int x = 0; x < rgb.cols; ++x) {
      const cv::Vec3b& colour = hsv.at<cv::Vec3b>(y, x);
      saturation.push_back(colour[1] / 255.0);
      const float excess = excess_green(rgb.at<cv::Vec3b>(y, x));
      excess_sum += excess;
      if (excess <= kGreener) continue;
      vegetation.hue.push_back(colour[0] * 2.0);
      vegetation.saturation.push_back(saturation.back());
      vegetation.value.push_back(colour[2] / 255.0);
    }
  }
  const double pixels = static_cast<double>(rgb.total());
  statistics.emplace_back("sat", mean_of(saturation));
  statistics.emplace_back("sat_sd", deviation_of(saturation));
  statistics.emplace_back("exg", excess_sum / pixels);
  if (static_cast<double>(vegetation.hue.size()) > kLeastVegetation * pixels) {
    statistics.emplace_back("veg_hue", percentile(vegetation.hue, 0.5));
    statistics.emplace_back("veg_hue_sd", deviation_of(vegetation.hue));
    statistics.emplace_back("veg_sat", mean_of(vegetation.saturation));
    statistics.emplace_back("veg_val_sd", deviation_of(vegetation.value));
  }
  statistics.emplace_back("white", cv::countNonZero(grey >= 250) / pixels);
  statistics.emplace_back("black", cv::countNonZero(grey <= 12) / pixels);
}

}  // namespace vinebench::harness
