// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>
#include <string>

namespace vinebench::harness {

inline constexpr double kMostPngCode = 65535;  ///< of 16 bits

/// How rows are compressed after the filter "Sub".
enum class PngRows {
  kRepetitions,  ///< libdeflate's fastest level: small where rows resemble each other
  kCodes         ///< Huffman codes alone: a third of the time and smaller for noisy images; half of
                 ///< the time, but larger, for labels
};

/// The bytes of a PNG: 8 or 16 bits a channel, one channel (grey) or three (RGB, not BGR). Throws
/// Error for other images.
std::string encode_png(const cv::Mat& image, PngRows rows = PngRows::kRepetitions);

}  // namespace vinebench::harness
