// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/truth/truth_images.h"

namespace vinebench::test {

inline double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 1e9;
  const auto at =
      values.begin() + static_cast<long>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

inline cv::Mat grey_of(const cv::Mat& rgb) {
  cv::Mat grey;
  cv::cvtColor(rgb, grey, cv::COLOR_RGB2GRAY);
  grey.convertTo(grey, CV_32F);
  return grey;
}

/// Image b warped to view a.
inline cv::Mat warped(const cv::Mat& b, const cv::Mat& flow, const cv::Vec2f& offset = {0, 0}) {
  cv::Mat map(flow.size(), CV_32FC2), result;
  for (int y = 0; y < flow.rows; ++y) {
    for (int x = 0; x < flow.cols; ++x) {
      map.at<cv::Vec2f>(y, x) = flow.at<cv::Vec2f>(y, x) + offset +
                                cv::Vec2f(static_cast<float>(x), static_cast<float>(y));
    }
  }
  cv::remap(b, result, map, {}, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  return result;
}

inline double mean_difference(const cv::Mat& a, const cv::Mat& b, const cv::Mat& mask) {
  cv::Mat difference;
  cv::absdiff(a, b, difference);
  return cv::mean(difference, mask)[0];
}

/// How far patches of 24 px of `b` (warped onto `a`) still are from a's, px: one step of Lucas and
/// Kanade's least squares over the pixels counted, where the patch has texture in both directions.
/// Pixels outside the mask do not contribute.
inline std::vector<double> patch_shifts(const cv::Mat& a, const cv::Mat& b, const cv::Mat& mask,
                                        const cv::Mat& counted) {
  constexpr int kSide = 24;
  cv::Mat mean = (a + b) / 2, dx, dy;
  cv::GaussianBlur(mean, mean, {5, 5}, 1.0);
  cv::Mat difference = a - b;
  cv::GaussianBlur(difference, difference, {5, 5}, 1.0);
  cv::Sobel(mean, dx, CV_32F, 1, 0, 3, 0.125);
  cv::Sobel(mean, dy, CV_32F, 0, 1, 3, 0.125);
  cv::Mat inner;
  cv::erode(mask, inner, cv::Mat::ones(5, 5, CV_8U));
  inner &= counted;
  std::vector<double> shifts;
  for (int top = 0; top + kSide <= a.rows; top += kSide) {
    for (int left = 0; left + kSide <= a.cols; left += kSide) {
      Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
      Eigen::Vector2d right = Eigen::Vector2d::Zero();
      int pixels = 0;
      for (int y = top; y < top + kSide; ++y) {
        for (int x = left; x < left + kSide; ++x) {
          if (inner.at<std::uint8_t>(y, x) == 0) continue;
          const Eigen::Vector2d g(dx.at<float>(y, x), dy.at<float>(y, x));
          normal += g * g.transpose();
          right += g * static_cast<double>(difference.at<float>(y, x));
          ++pixels;
        }
      }
      // Corners with sufficient texture for a tracker: 2 grey levels a pixel in both directions.
      const double weakest = normal.selfadjointView<Eigen::Upper>().eigenvalues().minCoeff();
      if (pixels < 60 || weakest < 4.0 * pixels) continue;
      shifts.push_back((normal.inverse() * right).norm());
    }
  }
  return shifts;
}

/// Where `there` says that b's pixel next to the place of a's pixel comes from, against that pixel;
/// px, for pixels of the mask. The step from the place to the middle of b's pixel is taken out.
inline std::vector<double> round_trips(const FlowTruth& here, const FlowTruth& there,
                                       const cv::Mat& mask) {
  std::vector<double> errors;
  for (int y = 0; y < mask.rows; ++y) {
    for (int x = 0; x < mask.cols; ++x) {
      if (mask.at<std::uint8_t>(y, x) == 0) continue;
      const cv::Vec2f forth = here.flow.at<cv::Vec2f>(y, x);
      const int u = std::clamp(cvRound(x + forth[0]), 0, mask.cols - 1);
      const int v = std::clamp(cvRound(y + forth[1]), 0, mask.rows - 1);
      errors.push_back(cv::norm(forth + there.flow.at<cv::Vec2f>(v, u)));
    }
  }
  return errors;
}

}  // namespace vinebench::test
