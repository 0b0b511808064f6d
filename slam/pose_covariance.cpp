// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/pose_covariance.h"

#include <utility>

namespace vinebench::slam {

void PoseCovariance::add_keyframe(const Pose& T_last_now, const TrackedFrame& tracked,
                                  const Eigen::MatrixXd& drift) {
  for (PoseUncertainty* of : {&now_, closed_ ? &*closed_ : nullptr}) {
    if (of == nullptr) continue;
    if (tracked.link) {
      of->cross_gap(T_last_now, tracked.link->covariance);
    } else {
      of->keyframe(T_last_now, tracked.motion.information, drift);
    }
  }
}

void PoseCovariance::join() {
  if (closed_) now_ = *std::exchange(closed_, std::nullopt);
}

PoseUncertainty& PoseCovariance::of_closed() {
  if (!live_) return now_;
  if (!closed_) closed_ = now_;
  return *closed_;
}

Matrix6d PoseCovariance::of_keyframe(const Eigen::MatrixXd& calibration,
                                     const ErrorOfImageTimes& times) const {
  return now_.at({}, Matrix6d::Zero()) +
         now_.of_calibration({}, calibration, times.by_calibration) + times.by_velocity;
}

Matrix6d PoseCovariance::of_frame(const Pose& T_last_now, const TrackedFrame& tracked,
                                  const Eigen::MatrixXd& calibration,
                                  const ErrorOfImageTimes& times) const {
  const Matrix6d information =
      tracked.tracked ? tracked.motion.information : Matrix6d(Matrix6d::Zero());
  return now_.at(T_last_now, information) +
         now_.of_calibration(T_last_now, calibration, times.by_calibration) + times.by_velocity;
}

}  // namespace vinebench::slam
