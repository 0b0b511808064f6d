// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

namespace vinebench::slam {

/// Black pixels side by side in a row.
struct BlackRun {
  int row;
  int first;   ///< px
  int last;    ///< px, the last black one
  int region;  ///< index into BlackRegions::regions
};

/// Black pixels joined along rows and columns.
struct BlackRegion {
  int left, right, top, bottom;  ///< px, the outermost pixels
  int pixels;
};

struct BlackRegions {
  std::vector<BlackRun> runs;  ///< row by row
  std::vector<BlackRegion> regions;
};

/// Parts a CV_8UC1 image into black and white as AprilTag does: against the middle between the
/// darkest and the brightest pixel of the 4 x 4 px tiles around; where these differ by less than
/// `contrast` it is neither. Joins the black ones.
BlackRegions find_black_regions(const cv::Mat& image, int contrast);

}  // namespace vinebench::slam
