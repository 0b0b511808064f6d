// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

namespace vinebench::slam {

/// A corner of one pyramid level.
struct Corner {
  int x = 0;  ///< px of that level
  int y = 0;
  int score = 0;  ///< grey levels: the highest FAST threshold at which it is still a corner
};

struct FastCellsConfig {
  int threshold = 20;     ///< grey levels
  int threshold_min = 7;  ///< grey levels; in cells without a corner at `threshold`
  int cell = 32;          ///< px, side of a cell
  int edge = 19;          ///< px, border of the image that is left out
};

/// FAST-9 corners (Rosten and Drummond 2006) of a CV_8UC1 image, one pixel apart at least, with
/// the threshold adapted to each cell. Row by row within the cells of one threshold; none where
/// the image is smaller than its borders.
std::vector<Corner> detect_fast_cells(const cv::Mat& image, const FastCellsConfig& config);

}  // namespace vinebench::slam
