// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <opencv2/core/mat.hpp>

#include "core/geometry/camera.h"

namespace vinebench::slam {

/// Places the corners of a tag's black square again, to a few hundredths of a pixel: the edge is
/// found along each side where the grey level rises from black to white, lines are fitted to the
/// four sides (in the undistorted image) and intersected. AprilTag itself looks for edges in
/// steps of a quarter of a pixel. By how much white has spread over black is told by the width of
/// the border and made good. `grey` is CV_8UC1, corners are px in AprilTag's order; the black
/// square is `modules` wide. Corners stay as they are where a side is not found. Returns the
/// standard deviation of a corner in x or y, px, the four taken together.
double refine_tag_corners(const cv::Mat& grey, const PinholeCamera& model, int modules,
                          std::array<Eigen::Vector2d, 4>& corners);

}  // namespace vinebench::slam
