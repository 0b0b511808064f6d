// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "slam/features/fast_corners.h"

namespace vinebench::slam {

struct FastCellsConfig {
  int threshold = 20;     ///< grey levels
  int threshold_min = 7;  ///< grey levels; in cells without a corner at `threshold`
  int cell = 32;          ///< px, side of a cell
  int edge = 19;          ///< px, border of the image that is left out
};

/// FAST-9 corners of a CV_8UC1 image with the threshold adapted to each cell, by row and column;
/// none where the image is smaller than its borders.
std::vector<Corner> detect_fast_cells(const cv::Mat& image, const FastCellsConfig& config);

}  // namespace vinebench::slam
