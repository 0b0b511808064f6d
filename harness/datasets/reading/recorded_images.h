// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>

#include "harness/datasets/reading/recording.h"

namespace vinebench::harness {

/// An image file as 8-bit grey, with the SLAM core's conversion; empty if it is damaged. Throws
/// Error for what read_image() refuses.
cv::Mat read_grey(const std::filesystem::path& file);

/// An image of a recording, from its store or its file.
cv::Mat read_grey(const Recording& recording, const std::filesystem::path& image);

/// Whether a frame's image is there; false for an empty name.
bool has_image(const Recording& recording, const std::filesystem::path& image);

/// Grey of an image as OpenCV decodes it: BGR or grey.
cv::Mat grey_of_decoded(const cv::Mat& image);

/// Size of the first readable image of that camera; empty if there is none.
cv::Size first_image_size(const Recording& recording, std::size_t camera);

}  // namespace vinebench::harness
