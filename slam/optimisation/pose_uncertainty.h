// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "core/geometry/pose.h"

namespace vinebench::slam {

/// The covariance of the body's pose in the map, in the step of step_of (body frame: m, then
/// rad).
///
/// From keyframe to keyframe errors add up; from a keyframe to the frames after it the motion-only
/// adjustment says how well each is held by the landmarks. That takes landmarks as exact, which
/// they are not, and errors as larger than most are, for the sake of their tails: `kInflation`
/// makes up for both. It was found, like those below, on drives of seeds that no table has
/// (docs/benchmarks.md).
///
/// Besides, all of a drive has errors that are no noise: what leaves and stereo's windows make of
/// where landmarks are is alike from keyframe to keyframe, so that lengths are off by the same
/// share and each metre driven turns the body by the same angle. `kScale` and `kTurn` are their
/// standard deviations.
///
/// Errors of the cameras' calibration are the same all the way, too. Such errors add up in a line:
/// kept is the step that each makes.
class PoseUncertainty {
 public:
  static constexpr double kInflation = 0.25;
  static constexpr double kScale = 5e-4;  ///< of lengths
  static constexpr double kTurn = 5e-5;   ///< rad/m, about each axis by the way along each

  /// The map begins here, or a tag of known pose has just fixed it.
  void start(const Matrix6d& covariance);

  /// A keyframe at T_last_now from the one before, held by that information, which each error of
  /// the calibrations (a column) moves by `drift`. While that is zero it is not known, and taken to
  /// have been what it is found to be.
  void keyframe(const Pose& T_last_now, const Matrix6d& information, const Eigen::MatrixXd& drift);

  /// The keyframe's pose was measured besides, with that covariance.
  void measure(const Matrix6d& covariance);

  /// An odometry gap ends in a keyframe. Its covariance knows of its own errors.
  void cross_gap(const Pose& T_last_now, const Matrix6d& covariance);

  /// Of a frame at T_last_now from the last keyframe; without information (a zero matrix) that of a
  /// period of dead reckoning is to be added by the caller.
  Matrix6d at(const Pose& T_last_now, const Matrix6d& information) const;

  /// What the calibrations' errors, of these second moments, add to that: as they drifted the
  /// keyframe, and as they move this frame alone, likewise a column for each.
  Matrix6d of_calibration(const Pose& T_last_now, const Eigen::MatrixXd& error,
                          const Eigen::MatrixXd& of_frame = {}) const;

 private:
  /// Steps by a scale, and by the turns about each axis by the way along each.
  using ByWay = Eigen::Matrix<double, 6, 10>;
  static ByWay of_way(const Eigen::Vector3d& way);

  Matrix6d noise_at(const Pose& T_last_now, const Matrix6d& information) const;
  ByWay by_way_at(const Pose& T_last_now) const;

  Matrix6d noise_ = Matrix6d::Zero();  ///< of the keyframe
  ByWay by_way_ = ByWay::Zero();       ///< the keyframe's step by an error of one sigma each
  /// The keyframe's step by each error; no columns for none.
  Eigen::Matrix<double, 6, Eigen::Dynamic> by_calibration_;
  int without_drift_ = 0;  ///< keyframes
};

}  // namespace vinebench::slam
