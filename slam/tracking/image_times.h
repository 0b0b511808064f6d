// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "core/geometry/pose.h"
#include "slam/camera/estimator_rig.h"
#include "slam/frame/frame_features.h"

namespace vinebench::slam {

/// How a frame's pose errs where it is not known exactly when its images were taken, or how the
/// body moved meanwhile: in the step of step_of (body frame: m, then rad). Unlike other errors of a
/// calibration these do not add up along the way: the pose is off by what the body drives in the
/// time by which it is off.
struct ErrorOfImageTimes {
  /// Step for a calibration's number that is 1 larger: a column for each number of to_vector(),
  /// zero but for times and readouts of pairs.
  Eigen::MatrixXd by_calibration;
  /// Covariance, of the velocity's error in the time until the images that were late.
  Matrix6d by_velocity = Matrix6d::Zero();
};

/// Each image counts by its share of the features that have a landmark. None with one is no error.
ErrorOfImageTimes error_of_image_times(const FrameFeatures& frame, const Associations& associations,
                                       const EstimatorRig& rig);

}  // namespace vinebench::slam
