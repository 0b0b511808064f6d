// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <string>

namespace vinebench::harness {

/// Writes an image as PNG or JPEG by the name's ending: CV_8UC3 (RGB), CV_8UC1, or CV_32FC1 (depth
/// in m, written as 16-bit PNG in mm). Throws Error for other endings and when it cannot be
/// written.
void write_image(const std::filesystem::path& file, const cv::Mat& image);

/// Decodes the bytes of an image as read_image() does; `name` is for errors.
cv::Mat decode_image(const std::string& bytes, const std::string& name, int flags);

/// Decodes an image file with OpenCV's flags (cv::IMREAD_*); empty if it is damaged. Throws Error
/// for what is no file or no image (PNG, JPEG, TIFF, WebP, BMP, PNM), and for one that is too
/// large: core/files/image_size.h.
cv::Mat read_image(const std::filesystem::path& file, int flags);

}  // namespace vinebench::harness
