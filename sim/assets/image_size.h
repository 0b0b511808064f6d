// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/types.hpp>
#include <optional>
#include <string_view>

namespace vinebench::sim {

/// Columns and rows of an image, from the header of its file, before memory is allocated for its
/// pixels. Supports PNG (ISO/IEC 15948), JPEG (ITU-T T.81) and TIFF (6.0); empty for other formats
/// and truncated headers.
std::optional<cv::Size2d> image_size(std::string_view bytes);

}  // namespace vinebench::sim
