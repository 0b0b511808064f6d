// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "slam/camera/estimator_rig.h"
#include "slam/map/map.h"

namespace vinebench::slam {

struct PoseSampling {
  int samples = 300;       ///< sets of three matches that are tried
  double pixel_limit = 4;  ///< px of the feature's level, of an inlier
  int min_inliers = 15;    ///< over all views
};

/// The body's pose that most of the associations agree on: three of one view give up to four poses
/// (P3P by OpenCV, after Ke and Roumeliotis 2017), each counted over all views of the rig (RANSAC:
/// Fischler and Bolles 1981). Unties the outliers. None where fewer than `min_inliers` agree. Draws
/// depend on the frame's index and `seed` alone.
std::optional<Pose> sample_pose(const Map& map, const FrameFeatures& frame, const EstimatorRig& rig,
                                const PoseSampling& sampling, std::uint64_t seed,
                                Associations& associations);

}  // namespace vinebench::slam
