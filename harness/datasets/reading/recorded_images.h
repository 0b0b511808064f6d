// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>

#include "harness/datasets/reading/recording.h"

namespace vinebench::harness {

/// An image file in eight bits of grey, as the SLAM core would make it grey; empty where the file
/// is no whole image.
cv::Mat read_grey(const std::filesystem::path& file);

/// Of the first image of that camera that can be read; empty where none can.
cv::Size first_image_size(const Recording& recording, std::size_t camera);

}  // namespace vinebench::harness
