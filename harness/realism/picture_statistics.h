// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>
#include <string>
#include <utility>
#include <vector>

namespace vinebench::harness {

/// Named properties of one picture, in a fixed order. Those that a picture does not have (colours
/// of vegetation where there is none) are absent.
using PictureStatistics = std::vector<std::pair<std::string, double>>;

/// Properties of a picture (CV_8UC3, RGB, at least 64 px each way) that feature detectors, stereo
/// and networks depend on; docs/realism.md defines each. Counts are for 100,000 px. They compare
/// between pictures of one width only.
PictureStatistics picture_statistics(const cv::Mat& rgb);

/// FAST, ORB and SIFT: how many features there are, how they spread, and how alike they are.
void add_feature_statistics(const cv::Mat& grey, PictureStatistics& statistics);

/// Gradients, contrast in windows of 16 px, edges, and the length of correlation.
void add_contrast_statistics(const cv::Mat& grey, PictureStatistics& statistics);

/// Slopes of the power spectrum averaged over all directions.
void add_spectrum_statistics(const cv::Mat& grey, PictureStatistics& statistics);

/// Saturation, hue of what is greener than red and blue, burnt-out and black shares.
void add_colour_statistics(const cv::Mat& rgb, const cv::Mat& grey, PictureStatistics& statistics);

/// A picture scaled to that width (px) and cut to 752:480 about its middle; a wider one keeps its
/// own height.
cv::Mat standard_picture(const cv::Mat& rgb, int width);

}  // namespace vinebench::harness
