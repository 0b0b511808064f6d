// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ceres/cost_function.h>

#include "slam/factors/calibration_belief.h"

namespace vinebench::slam {

/// Holds a rig's calibration where a belief has it: parameters are, of each pair, the left camera's
/// T_body_cam (7, as PoseManifold has it) and the other numbers (12), then the time of each camera
/// for tags (1); residuals are standard deviations.
class CalibrationFactor : public ceres::CostFunction {
 public:
  /// `T_body_nominal`: the left cameras as the rig file has them.
  CalibrationFactor(std::vector<Pose> T_body_nominal, const CalibrationBelief& belief);

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  /// Where the times of the cameras for tags begin in to_vector().
  Eigen::Index begin_of_times() const {
    return kPairUnknowns * static_cast<Eigen::Index>(T_body_nominal_.size());
  }

  std::vector<Pose> T_body_nominal_;
  Eigen::MatrixXd root_;  ///< of the information: root' root
  Eigen::VectorXd mean_;
};

}  // namespace vinebench::slam
