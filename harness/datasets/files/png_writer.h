// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>
#include <string>

namespace vinebench::harness {

/// The bytes of a PNG: 8 or 16 bits a channel, one channel (grey) or three (RGB, not BGR). Rows use
/// the filter "Sub" and libdeflate's fastest level: a fifth to a third less time than OpenCV's
/// default; noisy images are 4 to 9 % larger. Throws Error for other images.
std::string encode_png(const cv::Mat& image);

}  // namespace vinebench::harness
