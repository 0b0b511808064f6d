// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/realism/picture_statistics.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace vinebench::harness {

PictureStatistics picture_statistics(const cv::Mat& rgb) {
  cv::Mat grey;
  cv::cvtColor(rgb, grey, cv::COLOR_RGB2GRAY);
  PictureStatistics statistics;
  cv::Scalar mean;
  cv::Scalar deviation;
  cv::meanStdDev(grey, mean, deviation);
  statistics.emplace_back("mean", mean[0]);
  statistics.emplace_back("rms_contrast", deviation[0] / std::max(mean[0], 1.0));
  add_feature_statistics(grey, statistics);
  add_contrast_statistics(grey, statistics);
  add_spectrum_statistics(grey, statistics);
  add_colour_statistics(rgb, grey, statistics);
  return statistics;
}

cv::Mat standard_picture(const cv::Mat& rgb, int width) {
  const double scale = static_cast<double>(width) / rgb.cols;
  cv::Mat scaled;
  cv::resize(rgb, scaled, {width, static_cast<int>(std::lround(rgb.rows * scale))}, 0, 0,
             scale < 1 ? cv::INTER_AREA : cv::INTER_LINEAR);
  const int height = static_cast<int>(std::lround(480.0 * width / 752));
  const int top = std::max(0, (scaled.rows - height) / 2);
  return scaled.rowRange(top, std::min(scaled.rows, top + height)).clone();
}

}  // namespace vinebench::harness
