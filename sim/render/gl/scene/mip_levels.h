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

/// Likewise, of ground: straw, clods and grass cast shadows at every scale, which the mean of an
/// image's light does not have. The contrast of each level between near texels is raised to
/// kKeptContrast of the finest one's, by a factor of kMostRaised at most.
std::vector<cv::Mat> rough_mip_levels(const cv::Mat& rgba);
inline constexpr double kKeptContrast = 0.85;
inline constexpr double kMostRaised = 3.5;

/// Standard deviation of the green light (0 to 1) about the mean of 3 x 3 texels.
double near_contrast(const cv::Mat& rgba);

/// Share of the pixels whose alpha is at least one half.
double alpha_coverage(const cv::Mat& rgba);

}  // namespace vinebench::sim
