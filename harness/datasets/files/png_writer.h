// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>
#include <string>

namespace vinebench::harness {

inline constexpr double kMostPngCode = 65535;  ///< of 16 bits

/// What rows are compressed for.
enum class PngContent {
  kAreas,  ///< labels, geometry: runs of one value
  kNoise   ///< images of a sensor: Huffman codes alone
};

/// The bytes of a PNG: 8 or 16 bits a channel, one channel (grey) or three (RGB, not BGR). Throws
/// Error for other images.
std::string encode_png(const cv::Mat& image, PngContent content = PngContent::kAreas);

}  // namespace vinebench::harness
