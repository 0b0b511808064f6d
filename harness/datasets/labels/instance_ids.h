// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>

#include "core/truth/scene_index.h"

namespace vinebench::harness {

/// Ids (CV_32SC1, 0 to 2^24 - 1) as RGB.
cv::Mat id_colours(const cv::Mat& ids);

/// The id that a number of RenderedImage::instances has in images. Throws Error above 2^24 - 1.
std::int32_t instance_id(const SceneIndex& scene, std::int32_t number);

/// Those of every pixel (CV_32SC1 each). Throws likewise.
cv::Mat instance_ids(const SceneIndex& scene, const cv::Mat& numbers);

}  // namespace vinebench::harness
