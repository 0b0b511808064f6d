// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ceres/cost_function.h>

#include "slam/factors/calibration_belief.h"

namespace vinebench::slam {

/// Holds the pairs' calibrations where a belief has them: parameters are, of each pair, the left
/// camera's T_body_cam (7, as PoseManifold has it) and the other numbers (6); residuals are
/// standard deviations.
class CalibrationFactor : public ceres::CostFunction {
 public:
  /// `T_body_nominal`: the left cameras as the rig file has them.
  CalibrationFactor(std::vector<Pose> T_body_nominal, const CalibrationBelief& belief);

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  std::vector<Pose> T_body_nominal_;
  Eigen::MatrixXd root_;  ///< of the information: root' root
  Eigen::VectorXd mean_;
};

}  // namespace vinebench::slam
