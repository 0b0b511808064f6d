// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <memory>
#include <vector>

#include "slam/camera/estimator_rig.h"
#include "slam/factors/reprojection_factor.h"
#include "slam/optimisation/calibration_unknowns.h"
#include "slam/optimisation/problem_builder.h"

namespace vinebench::slam {

/// Reprojection errors, Eq. (5), of the landmarks that the moved keyframes see, in all keyframes
/// that take part; with the pairs' calibrations where these are unknown.
class LandmarkFactors : public FactorSource {
 public:
  /// Landmarks that fewer keyframes see are left out. The rig must outlive it, and so must
  /// `calibration`, which is null where calibrations are known and otherwise added before.
  explicit LandmarkFactors(const EstimatorRig& rig, int min_keyframes = 1,
                           CalibrationUnknowns* calibration = nullptr);

  void add_to(ProblemBuilder& problem, const Map& map) override;
  /// Observations beyond the 95 % of chi-square are to go, and landmarks look otherwise.
  void conclude(const std::vector<Pose>& T_map_bodies, const Map& map) override;
  void write_back(Map& map) const override;

 private:
  struct Term {
    std::size_t landmark;  ///< its place among those that take part
    Observation observation;
    const ReprojectionFactor* factor;
    double limit;  ///< of chi-square
  };
  struct Outlier {
    int landmark;
    Observation observation;
  };

  void add_landmark(const Landmark& landmark, const Map& map, ProblemBuilder& problem);

  const EstimatorRig& rig_;
  int min_keyframes_;
  CalibrationUnknowns* calibration_;
  std::unique_ptr<ceres::LossFunction> loss_;
  std::vector<int> landmark_ids_;  ///< ascending
  std::vector<Eigen::Vector3d> points_;
  std::deque<ReprojectionFactor> factors_;
  std::vector<Term> terms_;  ///< landmark by landmark
  std::vector<LandmarkLook> looks_;
  std::vector<Outlier> outliers_;
};

}  // namespace vinebench::slam
