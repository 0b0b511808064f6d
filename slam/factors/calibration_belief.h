// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/geometry/pair_calibration.h"

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

/// The calibrations of all pairs as one vector and back; kPairUnknowns numbers each.
Eigen::VectorXd to_vector(const std::vector<PairCalibration>& pairs);
std::vector<PairCalibration> from_vector(const Eigen::VectorXd& unknowns);

/// What is known of the calibrations of all pairs: a Gaussian over to_vector(), in information form
/// so that what several parts of a drive say adds up, and says nothing where it is zero.
struct CalibrationBelief {
  Eigen::MatrixXd information;         ///< inverse covariance
  Eigen::VectorXd information_vector;  ///< information times mean

  static CalibrationBelief nothing(std::size_t pairs);

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

/// What an adjustment says of the calibrations, and what these do to its last pose.
struct CalibrationMarginal {
  CalibrationBelief belief;
  /// Step of the last keyframe's pose, against the first one's, for a calibration's number that is
  /// 1 larger: six rows, a column for each number of to_vector().
  Eigen::MatrixXd of_last_pose;
};

}  // namespace vinebench::slam
