// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "harness/datasets/format/dataset_format.h"

namespace vinebench::harness {

/// Depth along the optical axis as 16-bit PNG in mm, 0 for sky and beyond 65.535 m.
DatasetFormat depth_format();

inline constexpr double kDepthRounding = 0.0005 + 1e-6;  ///< m

/// Depth (m) as CV_16UC1 in mm; 0 beyond 65.535 m.
cv::Mat millimetres(const cv::Mat& depth);

}  // namespace vinebench::harness
