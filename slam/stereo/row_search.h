// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>

namespace vinebench::slam {

/// How surely a window was found along a row.
struct RowSearch {
  int column = -1;  ///< px; -1 where the window or the whole range lies off the image
  int best = 0;     ///< sum of absolute differences there, grey levels
  int second = 0;   ///< the least one more than two columns away; INT_MAX where there is none
};

/// Looks for the 16 x 11 px window about (x, y) of `from` on the same row of `in`, with its centre
/// in the columns [first, last]. Both CV_8UC1 of one size. A rival matters where its sum is at most
/// `rivalry` times the best: `second` is exact there, and INT_MAX stands for any other.
RowSearch search_row(const cv::Mat& from, int x, int y, const cv::Mat& in, int first, int last,
                     double rivalry = 1e9);

}  // namespace vinebench::slam
