// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/geometry/rig_calibration.h"

namespace vinebench::slam {

/// Numbers of a pair's calibration: where its left camera is off, in the step of step_of (camera
/// frame: m, then rad), and the others of PairCalibration in their order.
inline constexpr int kPairUnknowns = 18;
inline constexpr int kLensUnknowns = kPairUnknowns - 6;

/// Where each of them begins among the pair's.
struct PairNumber {
  enum : Eigen::Index {
    kPlace = 0,
    kDirection = 3,
    kDisparityOffset = 6,
    kDisparitySlope,
    kFocal,
    kBaseline,
    kTime,
    kReadout,
    kPrincipalPoint,
    kRightTurn = kPrincipalPoint + 2,
    kRightAhead = kRightTurn + 3
  };
};

/// A rig's calibration as one vector and back: kPairUnknowns numbers of each pair, then the times
/// of the cameras for tags.
Eigen::VectorXd to_vector(const RigCalibration& rig);
RigCalibration from_vector(const Eigen::VectorXd& unknowns, std::size_t pairs);

/// What is known of a rig's calibration: a Gaussian over to_vector(), in information form so that
/// what several parts of a drive say adds up, and says nothing where it is zero.
struct CalibrationBelief {
  Eigen::MatrixXd information;         ///< inverse covariance
  Eigen::VectorXd information_vector;  ///< information times mean

  static CalibrationBelief nothing(std::size_t pairs, std::size_t tag_cameras = 0);

  /// Both need an information of full rank.
  Eigen::VectorXd mean() const;
  Eigen::MatrixXd covariance() const;

  CalibrationBelief operator+(const CalibrationBelief& other) const {
    return {information + other.information, information_vector + other.information_vector};
  }
  CalibrationBelief operator*(double weight) const {
    return {information * weight, information_vector * weight};
  }
};

/// What an adjustment says of the calibration, and what that does to its last pose.
struct CalibrationMarginal {
  CalibrationBelief belief;
  /// Step of the last keyframe's pose, against the first one's, for a calibration's number that is
  /// 1 larger: six rows, a column for each number of to_vector().
  Eigen::MatrixXd of_last_pose;
};

}  // namespace vinebench::slam
