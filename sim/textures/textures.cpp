// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/textures/textures.h"

#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

namespace vinebench::sim {

cv::Mat value_noise(cv::Size size, cv::Size cells, const RandomStream& random) {
  constexpr int kRim = 3;  // cells of the next tile, for a seamless interpolation
  cv::Mat grid(cells, CV_32F);
  for (int y = 0; y < cells.height; ++y) {
    for (int x = 0; x < cells.width; ++x) {
      grid.at<float>(y, x) = static_cast<float>(random.uniform(y * cells.width + x));
    }
  }
  if (cells == size) return grid;
  cv::Mat wrapped;
  cv::copyMakeBorder(grid, wrapped, kRim, kRim, kRim, kRim, cv::BORDER_WRAP);
  const double sx = static_cast<double>(size.width) / cells.width;
  const double sy = static_cast<double>(size.height) / cells.height;
  const cv::Size large(cvRound(wrapped.cols * sx), cvRound(wrapped.rows * sy));
  cv::Mat smooth;
  cv::resize(wrapped, smooth, large, 0, 0, cv::INTER_CUBIC);
  return smooth(cv::Rect(cv::Point(cvRound(kRim * sx), cvRound(kRim * sy)), size));
}

cv::Mat fractal_noise(cv::Size size, cv::Size cells, int octaves, double gain, std::uint64_t seed,
                      std::string_view name) {
  cv::Mat sum = cv::Mat::zeros(size, CV_32F);
  double height = 1;
  for (int octave = 0; octave < octaves; ++octave) {
    if (cells.width > size.width || cells.height > size.height) break;
    cv::scaleAdd(value_noise(size, cells, RandomStream(seed, name, octave)), height, sum, sum);
    height *= gain;
    cells *= 2;
  }
  cv::normalize(sum, sum, 0, 1, cv::NORM_MINMAX);
  return sum;
}

cv::Mat blend(const cv::Mat& amount, const cv::Vec3f& low, const cv::Vec3f& high) {
  cv::Mat out(amount.size(), CV_32FC3);
  for (int y = 0; y < amount.rows; ++y) {
    for (int x = 0; x < amount.cols; ++x) {
      out.at<cv::Vec3f>(y, x) = low + amount.at<float>(y, x) * (high - low);
    }
  }
  return out;
}

cv::Mat mix(const cv::Mat& amount, const cv::Mat& a, const cv::Mat& b) {
  cv::Mat out(amount.size(), CV_32FC3);
  for (int y = 0; y < amount.rows; ++y) {
    for (int x = 0; x < amount.cols; ++x) {
      const cv::Vec3f& from = a.at<cv::Vec3f>(y, x);
      out.at<cv::Vec3f>(y, x) = from + amount.at<float>(y, x) * (b.at<cv::Vec3f>(y, x) - from);
    }
  }
  return out;
}

cv::Mat to_rgba(const cv::Mat& rgb, const cv::Mat& alpha) {
  cv::Mat rgb8;
  rgb.convertTo(rgb8, CV_8UC3);
  cv::Mat opaque = alpha;
  if (opaque.empty()) opaque = cv::Mat(rgb.size(), CV_8UC1, cv::Scalar(255));
  cv::Mat rgba;
  cv::merge(std::vector<cv::Mat>{rgb8, opaque}, rgba);
  return rgba;
}

}  // namespace vinebench::sim
