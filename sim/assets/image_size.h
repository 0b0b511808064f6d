// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/types.hpp>
#include <optional>
#include <string_view>

namespace vinebench::sim {

/// Columns and rows of an image, from the header of its file, before any memory is taken for its
/// pixels. Knows PNG (ISO/IEC 15948), JPEG (ITU-T T.81) and TIFF (6.0); nothing for what is none of
/// them or ends before it says its size.
std::optional<cv::Size2d> image_size(std::string_view bytes);

}  // namespace vinebench::sim
