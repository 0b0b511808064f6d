// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

namespace vinebench::sim {

/// The colour filters over a sensor's pixels, row by row from the top left one.
enum class BayerPattern { kNone, kRggb, kGrbg, kGbrg, kBggr };

inline std::vector<std::string> yaml_names(BayerPattern) {
  return {"none", "rggb", "grbg", "gbrg", "bggr"};
}

/// Keeps of each RGB pixel (CV_8UC3) the colour that its filter lets through, CV_8UC1.
cv::Mat mosaic(const cv::Mat& rgb, BayerPattern pattern);

/// Full colours of a mosaic by OpenCV's edge-aware interpolation, CV_8UC3 RGB.
cv::Mat demosaic(const cv::Mat& mosaic, BayerPattern pattern);

}  // namespace vinebench::sim
