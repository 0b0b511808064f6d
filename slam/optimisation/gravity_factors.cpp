// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/optimisation/gravity_factors.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "slam/factors/reprojection.h"
#include "slam/optimisation/gravity_fit.h"

namespace vinebench::slam {
namespace {

/// Of what is believed of gravity beforehand.
constexpr double kGlobalInflation = 1e4;

}  // namespace

GravityFactors::GravityFactors(const std::optional<InertialNoise>& inertial, bool global)
    : inertial_(inertial), global_(global), huber_(std::sqrt(kChiSquared3)) {}

void GravityFactors::add_to(ProblemBuilder& problem, const Map& map) {
  if (!inertial_ || !map.gravity()) return;
  const std::vector<int>& moved = problem.window().moved;
  const auto moves = [&](int id) { return std::ranges::binary_search(moved, id); };
  for (int k = 2; k < static_cast<int>(map.keyframes().size()); ++k) {
    if (!problem.takes_part(k - 2) || !problem.takes_part(k - 1) || !problem.takes_part(k))
      continue;
    if (!moves(k - 2) && !moves(k - 1) && !moves(k)) continue;
    const auto felt = felt_gravity(map, k, *inertial_);
    if (!felt) continue;
    if (factors_.empty()) believe(*map.gravity(), problem);
    factors_.emplace_back(felt->before, felt->after, felt->sigma);
    problem.add_factor(
        factors_.back(), &huber_,
        {problem.pose_of(k - 2), problem.pose_of(k - 1), problem.pose_of(k), gravity_.data()});
  }
}

void GravityFactors::write_back(Map& map) const {
  if (!global_ || factors_.empty()) return;
  map.gravity()->gravity = Eigen::Map<const Eigen::Vector3d>(gravity_.data());
}

void GravityFactors::believe(const MapGravity& known, ProblemBuilder& problem) {
  Vector6d mean;
  mean << known.gravity, known.accelerometer_bias;
  std::ranges::copy(mean, gravity_.begin());
  problem.add_block(gravity_.data(), 6, ProblemBuilder::Group::kInertial);
  const Matrix6d covariance =
      (global_ && !known.by_world ? kGlobalInflation : 1) * known.covariance;
  const Matrix6d root = covariance.inverse().llt().matrixU();
  belief_ = std::make_unique<ceres::NormalPrior>(root, mean);
  problem.add_factor(*belief_, nullptr, {gravity_.data()});
}

}  // namespace vinebench::slam
