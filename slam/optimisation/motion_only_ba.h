// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "slam/camera/estimator_rig.h"
#include "slam/map/map.h"

namespace vinebench::slam {

struct MotionEstimate {
  Pose T_map_body;
  /// Inverse covariance of the pose against the landmarks, in the step of PoseManifold (body frame:
  /// m, then rad), from the robust weights of the last round. Zero where there was none.
  Matrix6d information = Matrix6d::Zero();
  int inliers = 0;
  std::vector<int> matches_per_view;
  std::vector<int> inliers_per_view;
};

/// Motion-only bundle adjustment, Eq. (1)-(3): the body pose that minimises the reprojection errors
/// of all associated landmarks over all cameras of the rig, landmarks held fixed;
/// first Huber's, then the rig's loss, weights by octave. Rounds of adjustment and removal of
/// outliers (95 % chi-square); associations that are outliers in the end are untied.
///
/// A view whose share of inliers stays below `min_inlier_share` while another's does not is not
/// believed: its associations are all untied and the pose is adjusted without it.
MotionEstimate estimate_motion(const Map& map, const FrameFeatures& frame, const Pose& prediction,
                               const EstimatorRig& rig, double min_inlier_share,
                               Associations& associations);

}  // namespace vinebench::slam
