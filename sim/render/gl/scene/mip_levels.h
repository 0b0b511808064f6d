// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

namespace vinebench::sim {

/// An image (CV_8UC4, sRGB) at full, half, quarter, ... size down to one pixel. Light is averaged
/// as light. In a cut-out the alpha of each level is scaled so that the same share of it passes one
/// half as in the finest level: far leaves keep their area.
std::vector<cv::Mat> mip_levels(const cv::Mat& rgba, bool cutout);

/// Share of the pixels whose alpha is at least one half.
double alpha_coverage(const cv::Mat& rgba);

}  // namespace vinebench::sim
