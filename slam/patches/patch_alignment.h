// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>

namespace vinebench::slam {

/// Where a window of the left image lies in the right one.
struct PatchAlignment {
  double shift = 0;       ///< px of this level, x_left - x_right at the window's centre
  double slope_x = 0;     ///< change of the shift along x, px a px: a surface slanted that way
  double slope_y = 0;     ///< along y
  double difference = 0;  ///< grey levels, mean absolute difference after alignment
  double contrast = 0;    ///< grey levels, mean absolute deviation of the left window
};

/// Finds an 11 x 11 px window about (x, y) of `left` on the same rows of `right`, a rectified pair
/// of CV_8UC1. Searches whole shifts about `guess` by the sum of absolute differences, then solves
/// for shift, slope of the shift along x and y (a slanted surface) and brightness by Gauss-Newton
/// steps with the gradients of the left window (after Baker and Matthews, "Lucas-Kanade 20 years
/// on", 2004). None where the window leaves an image or no minimum is found.
std::optional<PatchAlignment> align_patch(const cv::Mat& left, const cv::Mat& right, int x, int y,
                                          double guess);

}  // namespace vinebench::slam
