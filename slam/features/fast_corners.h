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

/// FAST-9 corners (Rosten and Drummond 2006) within `area` of a CV_8UC1 image, by row and column:
/// pixels from which nine neighbours in a row, of the 16 on a circle of radius 3, all differ to the
/// same side by more than `least` (1 to 255 grey levels), and whose score is above those of the
/// eight pixels around. None within 3 px of the image's borders. The same ones whatever the width
/// of the processor's vectors.
std::vector<Corner> fast_corners(const cv::Mat& image, const cv::Rect& area, int least);

}  // namespace vinebench::slam
