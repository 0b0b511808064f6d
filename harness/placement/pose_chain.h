// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/geometry/pose.h"

namespace vinebench::harness {

/// What odometry is off by after one metre, along or about one axis; it grows with the root of the
/// way.
struct OdometryDrift {
  double offset = 1e-3;  ///< m
  double turn = 2e-4;    ///< rad
};

/// How sure the poses of a drive are by odometry and by what is measured of some of them: a chain
/// of linear Gaussian steps, of which a Kalman filter and a smoother (Rauch, Tung and Striebel
/// 1965) give the covariances. Poses' errors are steps in their own axes (m, then rad).
class PoseChain {
 public:
  /// Of the body in the world, in order. The first is known: errors count from there.
  PoseChain(const std::vector<Pose>& poses, const OdometryDrift& drift);

  std::size_t size() const { return carried_.size(); }

  /// What the measurements, an information matrix a pose, tell of all poses together: half the
  /// logarithm of the ratio of determinants, nats. It is a submodular function of the set of
  /// measurements.
  double information(const std::vector<Matrix6d>& measured) const;

  /// Root mean square of each pose's distance from the truth, m.
  std::vector<double> position_errors(const std::vector<Matrix6d>& measured) const;

 private:
  std::vector<Matrix6d> carried_;  ///< the step of a pose that one of the pose before makes
  std::vector<Matrix6d> noise_;    ///< of the way between, in the pose's axes
};

/// The value that so many (0 to 1) of the errors are at most.
double share_of(std::vector<double> errors, double share);

}  // namespace vinebench::harness
