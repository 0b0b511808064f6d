// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "slam/factors/calibration_belief.h"

namespace vinebench::slam {

/// What is known of the calibrations where some of their numbers may be exactly as the rig file has
/// them.
struct CalibrationAverage {
  Eigen::VectorXd mean;        ///< of to_vector()
  Eigen::MatrixXd covariance;  ///< likewise
  double file_is_right = 0;    ///< the probability that all of them are
  double numbers_at_work = 0;  ///< how many are not, expected
};

/// The mean over all sets of causes that may be at work, by their evidence (Hoeting et al.,
/// "Bayesian model averaging: a tutorial", 1999), where every second rig file is right, and in a
/// wrong one each cause is at work or not with equal chances. `prior` is the file's accuracy, `now`
/// that and what was seen, both of so many pairs and of full rank. What a set of causes explains is
/// weighed against what its vagueness promised in vain, so that nothing is a matter of a threshold.
CalibrationAverage average(const CalibrationBelief& now, const CalibrationBelief& prior,
                           std::size_t pairs);

}  // namespace vinebench::slam
