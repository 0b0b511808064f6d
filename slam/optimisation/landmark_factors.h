// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ceres/normal_prior.h>

#include <cstdint>
#include <deque>
#include <memory>
#include <vector>

#include "slam/camera/estimator_rig.h"
#include "slam/factors/reprojection_factor.h"
#include "slam/factors/robust_loss.h"
#include "slam/optimisation/calibration_unknowns.h"
#include "slam/optimisation/problem_builder.h"

namespace vinebench::slam {

/// Reprojection errors, Eq. (5), of the landmarks that the moved keyframes see, in all keyframes
/// that take part; with the pairs' calibrations where these are unknown.
class LandmarkFactors : public FactorSource, private Sights {
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
  /// Of a landmark, by its place among those that take part.
  struct Seen {
    std::uint32_t landmark;
    Observation observation;
  };
  struct Outlier {
    int landmark;
    Observation observation;
  };

  double cost(std::size_t sight, const Pose& T_map_body,
              const Eigen::Vector3d& p_map) const override;
  Linearised linearise(std::size_t sight, const Pose& T_map_body,
                       const Eigen::Vector3d& p_map) const override;

  PixelMeasurement measurement(const Observation& o) const;
  const StereoCameraModel& camera(const Observation& o) const;
  void add_factors(ProblemBuilder& problem);
  void add_velocities(ProblemBuilder& problem);
  void add_sights(ProblemBuilder& problem);

  const EstimatorRig& rig_;
  int min_keyframes_;
  CalibrationUnknowns* calibration_;
  std::unique_ptr<ceres::LossFunction> loss_;
  RobustLoss weights_;                                        ///< the same
  std::vector<std::shared_ptr<const FrameFeatures>> frames_;  ///< of what takes part, by keyframe
  std::vector<int> landmark_ids_;                             ///< ascending
  std::vector<Eigen::Vector3d> points_;
  std::vector<Seen> seen_;                  ///< landmark by landmark
  std::deque<ReprojectionFactor> factors_;  ///< of these, unless there are many keyframes
  std::vector<Vector6d> velocities_;        ///< of the keyframes that have late images
  std::vector<double*> velocity_blocks_;    ///< by keyframe; null where there are none
  std::deque<ceres::NormalPrior> velocity_beliefs_;
  std::vector<LandmarkLook> looks_;
  std::vector<Outlier> outliers_;
};

}  // namespace vinebench::slam
