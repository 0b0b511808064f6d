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
/// Besides, a drive has errors that are no noise: what leaves and stereo's windows make of where
/// landmarks are is alike from keyframe to keyframe, so that lengths are off by a share and each
/// metre driven turns the body by an angle. `kScale` and `kTurn` are the standard deviations of
/// these rates. Other surroundings have others: along the way they are Gauss-Markov processes,
/// whose correlation falls to 1/e within `kAlike`. A way back is not quite that there with other
/// signs.
///
/// Errors of the cameras' calibration are the same all the way. Such errors add up in a line: kept
/// is the step that each makes.
class PoseUncertainty {
 public:
  static constexpr double kInflation = 0.5;
  static constexpr double kScale = 5e-4;  ///< of lengths
  static constexpr double kTurn = 1e-4;   ///< rad/m, about each axis by the way along each
  static constexpr double kAlike = 0.5;   ///< m

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
  /// A scale, and turns about each axis by the way along each.
  static constexpr int kRates = 10;
  /// Of the keyframe's step, then of these rates in their standard deviations.
  using Covariance = Eigen::Matrix<double, 6 + kRates, 6 + kRates>;

  static Covariance of_start(const Matrix6d& covariance);
  Covariance moved(const Pose& T_last_now) const;

  Covariance known_ = of_start(Matrix6d::Zero());
  /// The keyframe's step by each error; no columns for none.
  Eigen::Matrix<double, 6, Eigen::Dynamic> by_calibration_;
  int without_drift_ = 0;  ///< keyframes
};

}  // namespace vinebench::slam
