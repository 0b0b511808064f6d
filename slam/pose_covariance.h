// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "slam/optimisation/pose_uncertainty.h"
#include "slam/tracking/image_times.h"
#include "slam/tracking/tracker.h"

namespace vinebench::slam {

/// The covariance that is told with each pose, in the body frame (m, then rad), over a drive and
/// its loops. What a loop makes surer holds at once in lockstep; live, the map is not there before
/// the loop's global adjustment has joined, and until then the pose is as unsure as before.
class PoseCovariance {
 public:
  explicit PoseCovariance(bool live) : live_(live) {}

  /// The map begins here.
  void begin(const Matrix6d& covariance) { now_.start(covariance); }

  /// A keyframe at T_last_now from the one before; each error of the calibrations (a column) moves
  /// it by `drift`.
  void add_keyframe(const Pose& T_last_now, const TrackedFrame& tracked,
                    const Eigen::MatrixXd& drift);

  /// A loop says of the latest keyframe's pose how sure it is, whatever was known before.
  void close(const Matrix6d& covariance) { of_closed().start(covariance); }

  /// A loop measured that pose besides, independently, with that covariance.
  void close_besides(const Matrix6d& covariance) { of_closed().measure(covariance); }

  /// A global adjustment joined, live.
  void join();

  /// Of the latest keyframe, and of a frame at T_last_now from it, which for one that was dead
  /// reckoned leaves its covariance to be added. `calibration` has the second moments of the
  /// calibrations' errors, and `times` what not knowing when images were taken adds.
  Matrix6d of_keyframe(const Eigen::MatrixXd& calibration,
                       const ErrorOfImageTimes& times = {}) const;
  Matrix6d of_frame(const Pose& T_last_now, const TrackedFrame& tracked,
                    const Eigen::MatrixXd& calibration, const ErrorOfImageTimes& times = {}) const;

 private:
  PoseUncertainty& of_closed();

  bool live_;
  PoseUncertainty now_;
  std::optional<PoseUncertainty> closed_;  ///< what it will be once a loop's adjustment has joined
};

}  // namespace vinebench::slam
