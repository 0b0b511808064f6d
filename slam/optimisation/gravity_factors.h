// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ceres/normal_prior.h>

#include <array>
#include <deque>
#include <memory>
#include <optional>

#include "slam/factors/gravity_factor.h"
#include "slam/odometry/inertial_config.h"
#include "slam/optimisation/problem_builder.h"

namespace vinebench::slam {

/// Gravity between any three keyframes in a row that take part, of which one moves: it keeps the
/// map's roll and pitch over any distance, and how fast the body's velocity changes. Gravity and
/// the accelerometer's bias are one more unknown, as the map has them beforehand.
class GravityFactors : public FactorSource {
 public:
  /// None without an inertial unit. In a `global` adjustment what the map believes of gravity
  /// hardly counts, unless the world says it: it came from the same readings, and they say it anew.
  GravityFactors(const std::optional<InertialNoise>& inertial, bool global);
  void add_to(ProblemBuilder& problem, const Map& map) override;

  /// After a `global` adjustment the map's gravity is what was found; what comes of a few keyframes
  /// is the filter's to know.
  void write_back(Map& map) const override;

 private:
  void believe(const MapGravity& known, ProblemBuilder& problem);

  std::optional<InertialNoise> inertial_;
  bool global_;
  std::array<double, 6> gravity_{};  ///< and the bias
  std::unique_ptr<ceres::NormalPrior> belief_;
  ceres::HuberLoss huber_;
  std::deque<GravityFactor> factors_;
};

}  // namespace vinebench::slam
