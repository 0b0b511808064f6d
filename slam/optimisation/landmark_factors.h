// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <memory>
#include <vector>

#include "slam/camera/estimator_rig.h"
#include "slam/factors/reprojection_factor.h"
#include "slam/optimisation/problem_builder.h"

namespace vinebench::slam {

/// Reprojection errors, Eq. (5), of the landmarks that the moved keyframes see, in all keyframes
/// that take part; with the pairs' disparity offsets where these are unknown.
class LandmarkFactors : public FactorSource {
 public:
  /// The rig must outlive it.
  LandmarkFactors(const EstimatorRig& rig, bool offsets_unknown);

  void add_to(ProblemBuilder& problem, const Map& map) override;
  void write_back(Map& map) const override;
  /// Observations beyond the 95 % of chi-square.
  void remove_outliers(Map& map) const override;

  /// Lets the offsets, which are held at first, be estimated.
  void free_offsets(ProblemBuilder& problem);
  /// Of each pair, px.
  const std::vector<double>& disparity_offsets() const { return offsets_; }

 private:
  struct Term {
    int landmark;
    Observation observation;
    const ReprojectionFactor* factor;
    double limit;  ///< of chi-square
  };

  void add_landmark(const Landmark& landmark, const Map& map, ProblemBuilder& problem);
  double* offset_of(std::size_t view, ProblemBuilder& problem);

  const EstimatorRig& rig_;
  bool offsets_unknown_;
  std::unique_ptr<ceres::LossFunction> loss_;
  std::vector<int> landmark_ids_;  ///< ascending
  std::vector<Eigen::Vector3d> points_;
  std::deque<ReprojectionFactor> factors_;
  std::vector<Term> terms_;
  std::vector<double> offsets_;  ///< px, of each view
  std::vector<char> offset_used_;
};

}  // namespace vinebench::slam
