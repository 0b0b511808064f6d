// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/optimisation/gravity_fit.h"

#include <Eigen/Cholesky>
#include <cmath>

#include "slam/factors/gravity_factor.h"
#include "slam/factors/pose_manifold.h"

namespace vinebench::slam {
namespace {

/// Over longer intervals what the gyroscope does not know of the turn counts, and a body that
/// stands may have been touched.
constexpr double kLongest = 2;  // s

bool is_usable(const std::optional<PreintegratedMotion>& motion) {
  return motion && motion->seconds > 0 && motion->seconds <= kLongest;
}

/// White noise of density s, integrated twice over t and divided by it, is s sqrt(t / 3) in each of
/// the two mean velocities. The turn within an interval turns gravity.
double sigma(double seconds, const InertialNoise& inertial) {
  const double force = 2 * inertial.accelerometer.noise_density / std::sqrt(3 * seconds);
  const double turn = inertial.gyroscope.noise_density * std::sqrt(seconds / 3);
  return std::hypot(force, kStandardGravity * turn);
}

}  // namespace

std::optional<FeltGravity> felt_gravity(const Map& map, int last, const InertialNoise& inertial) {
  if (last < 2) return std::nullopt;
  const std::optional<PreintegratedMotion>& before = map.keyframe(last - 1).motion;
  const std::optional<PreintegratedMotion>& after = map.keyframe(last).motion;
  if (!is_usable(before) || !is_usable(after)) return std::nullopt;
  return FeltGravity{*before, *after, sigma(before->seconds + after->seconds, inertial)};
}

std::optional<MapGravity> fit_gravity(const Map& map, const InertialNoise& inertial) {
  // The factor is linear in gravity and bias: its residual at zero and its Jacobian say all.
  Matrix6d information = Matrix6d::Zero();
  Vector6d pull = Vector6d::Zero();
  information.diagonal().tail<3>().setConstant(std::pow(inertial.accelerometer.bias, -2));
  const Vector6d zero = Vector6d::Zero();
  bool felt_any = false;
  for (int k = 2; k < static_cast<int>(map.keyframes().size()); ++k) {
    const auto felt = felt_gravity(map, k, inertial);
    if (!felt) continue;
    felt_any = true;
    const PoseBlock poses[] = {to_block(map.keyframe(k - 2).T_map_body),
                               to_block(map.keyframe(k - 1).T_map_body),
                               to_block(map.keyframe(k).T_map_body)};
    const double* parameters[] = {poses[0].data(), poses[1].data(), poses[2].data(), zero.data()};
    Eigen::Vector3d residual;
    Eigen::Matrix<double, 3, 6, Eigen::RowMajor> J;
    double* jacobians[] = {nullptr, nullptr, nullptr, J.data()};
    GravityFactor(felt->before, felt->after, felt->sigma)
        .Evaluate(parameters, residual.data(), jacobians);
    information += J.transpose() * J;
    pull -= J.transpose() * residual;
  }
  if (!felt_any) return std::nullopt;
  const Matrix6d covariance = information.ldlt().solve(Matrix6d::Identity());
  const Vector6d best = covariance * pull;
  return MapGravity{best.head<3>(), best.tail<3>(), covariance};
}

}  // namespace vinebench::slam
