// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

namespace vinebench::slam {

/// Where in a CV_8UC1 image a tag with a black border may be: rectangles in a fixed order, each
/// with as much around the border as it takes to read the tag. They may overlap.
///
/// Sees the image as AprilTag's own search does (Wang and Olson, "AprilTag 2", 2016): every
/// `step`-th pixel, black or white against its surroundings, joined to regions. A region stays a
/// candidate if its outline is a quadrilateral's and there is white within. Such a region is what
/// AprilTag makes its quadrilaterals of, so a tag that it would find lies in a candidate.
std::vector<cv::Rect> find_tag_candidates(const cv::Mat& grey, int step);

}  // namespace vinebench::slam
