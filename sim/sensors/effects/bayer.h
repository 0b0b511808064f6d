// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "sim/sensors/effects/effect.h"

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

/// The filters before the noise, and the interpolation after it. Null for a sensor without filters.
std::unique_ptr<CodeEffect> make_colour_filters(BayerPattern pattern);
std::unique_ptr<CodeEffect> make_colour_interpolation(BayerPattern pattern);

}  // namespace vinebench::sim
