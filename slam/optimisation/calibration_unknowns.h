// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "slam/camera/estimator_rig.h"
#include "slam/factors/calibration_factor.h"
#include "slam/optimisation/problem_builder.h"

namespace vinebench::slam {

/// A rig's calibration as unknowns of an adjustment, and what is believed of it beforehand.
class CalibrationUnknowns : public FactorSource {
 public:
  /// Begins with the rig's calibration. The belief must have full rank.
  CalibrationUnknowns(const EstimatorRig& rig, const CalibrationBelief& belief);

  void add_to(ProblemBuilder& problem, const Map& map) override;

  /// Blocks of a pair: T_body_cam of the left camera (7), and the rest of its calibration (12).
  double* camera(std::size_t view) { return cameras_[view].data(); }
  double* lens(std::size_t view) { return lenses_[view].data(); }
  /// Block of a camera for tags, by index among those in use: its time (1).
  double* tag_time(std::size_t tag_camera) { return &tag_times_[tag_camera]; }

  RigCalibration found() const;

  /// What the adjustment, once solved, says of them with all else unknown too: the belief
  /// beforehand and the factors' own information, which is the Schur complement of all other
  /// unknowns.
  CalibrationMarginal marginal(ProblemBuilder& problem) const;

 private:
  using Lens = std::array<double, kLensUnknowns>;

  std::vector<Pose> T_body_nominal_;
  CalibrationFactor factor_;
  std::vector<PoseBlock> cameras_;
  std::vector<Lens> lenses_;
  std::vector<double> tag_times_;
};

}  // namespace vinebench::slam
