// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <opencv2/core/mat.hpp>

namespace vinebench::harness {

/// The colour of one of RenderedImage::instances' numbers, RGB: black for none, else not dark.
cv::Vec3b instance_colour(std::int32_t number);

/// RenderedImage::instances as colours for display, CV_8UC3: one for each instance and part, black
/// for none.
cv::Mat colour_instances(const cv::Mat& instances);

/// RenderedImage::normals in colours, CV_8UC3: red to the right, green up, blue towards the camera,
/// each from -1 (0) to 1 (255); black for sky.
cv::Mat colour_normals(const cv::Mat& normals);

/// Flow (CV_32FC2, px) on the colour wheel, CV_8UC3: hue for the direction (red to the right, then
/// yellow down), white for none, full colour for the longest of 99 % of the pixels; black for NaN.
cv::Mat colour_flow(const cv::Mat& flow);

/// Writes flow as Middlebury's .flo (1e10 for NaN) or as a .png or .jpg of colour_flow(). Throws
/// Error for other endings and if it cannot be written.
void write_flow(const std::filesystem::path& file, const cv::Mat& flow);

/// Disparity (CV_32FC1, px) as KITTI stores it: CV_16UC1 of 1/256 px, 0 for none.
cv::Mat kitti_disparity(const cv::Mat& disparity);

}  // namespace vinebench::harness
