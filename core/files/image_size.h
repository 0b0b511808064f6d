// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/types.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace vinebench {

/// Columns and rows of an image, from the header of its file, before memory is allocated for its
/// pixels. Supports PNG (ISO/IEC 15948), JPEG (ITU-T T.81), TIFF (6.0), WebP (RFC 9649), BMP and
/// the Netpbm formats; empty for other formats and truncated headers.
std::optional<cv::Size2d> image_size(std::string_view bytes);

/// Pixels of the largest image that is decoded: a file of some kilobytes can state gigapixels.
inline constexpr double kMostPixels = 100e6;

/// Throws Error that names `where` unless the bytes begin like an image of one of these formats, of
/// at most kMostPixels.
void check_image_size(std::string_view bytes, const std::string& where);

}  // namespace vinebench
