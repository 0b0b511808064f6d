// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/optimisation/gravity_factors.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "slam/factors/reprojection.h"

namespace vinebench::slam {
namespace {

/// Over longer intervals what the gyroscope does not know of the turn counts, and a body that
/// stands may have been touched.
constexpr double kLongest = 2;  // s

/// Of what is believed of gravity beforehand.
constexpr double kGlobalInflation = 1e4;

bool is_usable(const std::optional<PreintegratedMotion>& motion) {
  return motion && motion->seconds > 0 && motion->seconds <= kLongest;
}

}  // namespace

GravityFactors::GravityFactors(const std::optional<InertialConfig>& inertial, bool global)
    : inertial_(inertial), global_(global), huber_(std::sqrt(kChiSquared3)) {}

/// White noise of density s, integrated twice over t and divided by it, is s sqrt(t / 3) in each of
/// the two mean velocities. The turn within an interval turns gravity.
double GravityFactors::sigma(const PreintegratedMotion& before,
                             const PreintegratedMotion& after) const {
  const double seconds = before.seconds + after.seconds;
  const double force = 2 * inertial_->accelerometer.noise_density / std::sqrt(3 * seconds);
  const double turn = inertial_->gyroscope.noise_density * std::sqrt(seconds / 3);
  return std::hypot(force, kStandardGravity * turn);
}

void GravityFactors::add_to(ProblemBuilder& problem, const Map& map) {
  if (!inertial_ || !map.gravity()) return;
  const std::vector<int>& moved = problem.window().moved;
  const auto moves = [&](int id) { return std::ranges::binary_search(moved, id); };
  for (int k = 2; k < static_cast<int>(map.keyframes().size()); ++k) {
    const std::optional<PreintegratedMotion>& before = map.keyframe(k - 1).motion;
    const std::optional<PreintegratedMotion>& after = map.keyframe(k).motion;
    if (!is_usable(before) || !is_usable(after)) continue;
    if (!problem.takes_part(k - 2) || !problem.takes_part(k - 1) || !problem.takes_part(k))
      continue;
    if (!moves(k - 2) && !moves(k - 1) && !moves(k)) continue;
    if (factors_.empty()) believe(*map.gravity(), problem);
    factors_.emplace_back(*before, *after, sigma(*before, *after));
    problem.add_factor(
        factors_.back(), &huber_,
        {problem.pose_of(k - 2), problem.pose_of(k - 1), problem.pose_of(k), gravity_.data()});
  }
}

void GravityFactors::believe(const MapGravity& known, ProblemBuilder& problem) {
  Vector6d mean;
  mean << known.gravity, known.accelerometer_bias;
  std::ranges::copy(mean, gravity_.begin());
  problem.add_block(gravity_.data(), 6, ProblemBuilder::Group::kInertial);
  const Matrix6d covariance = (global_ ? kGlobalInflation : 1) * known.covariance;
  const Matrix6d root = covariance.inverse().llt().matrixU();
  belief_ = std::make_unique<ceres::NormalPrior>(root, mean);
  problem.add_factor(*belief_, nullptr, {gravity_.data()});
}

}  // namespace vinebench::slam
