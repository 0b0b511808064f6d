// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>

#include "harness/datasets/reading/recording.h"

namespace vinebench::harness {

/// An image file as 8-bit grey, with the SLAM core's conversion; empty if it is damaged. Throws
/// Error for what read_image() refuses.
cv::Mat read_grey(const std::filesystem::path& file);

/// Size of the first readable image of that camera; empty if there is none.
cv::Size first_image_size(const Recording& recording, std::size_t camera);

}  // namespace vinebench::harness
