// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/loop/levelling.h"

#include <Eigen/Cholesky>
#include <cmath>

#include "core/geometry/cross_matrix.h"
#include "slam/loop/loop_correction.h"
#include "slam/optimisation/gravity_fit.h"

namespace vinebench::slam {
namespace {

/// 99.9 % of the chi-square distribution with two degrees of freedom.
constexpr double kLeanLimit = 13.82;

/// How exactly the world's z axis is the vertical.
constexpr double kVertical = 2e-4;  // rad

/// Covariance of how all of the way is turned on average against its ends, by the errors of its
/// steps: a third of what they add up to.
Eigen::Matrix3d mean_turn(const Map& map) {
  double way = 0;
  for (std::size_t k = 1; k < map.keyframes().size(); ++k) {
    way +=
        (map.keyframes()[k].T_map_body.translation - map.keyframes()[k - 1].T_map_body.translation)
            .norm();
  }
  return kStepTurn * kStepTurn * way / 3 * Eigen::Matrix3d::Identity();
}

}  // namespace

std::optional<Eigen::Quaterniond> levelling_turn(const MapGravity& felt,
                                                 const Eigen::Vector3d& down,
                                                 const Eigen::Matrix3d& lean) {
  const double strength = felt.gravity.norm();
  const Eigen::Vector3d along = felt.gravity / strength;
  Eigen::Matrix<double, 3, 2> level;  // the axes that a lean is about
  level.col(0) = down.unitOrthogonal();
  level.col(1) = down.cross(level.col(0));
  const Eigen::Vector2d angle =
      level.transpose() * log_so3(Eigen::Quaterniond::FromTwoVectors(along, down));
  // An error of gravity turns it by (along x error) / strength.
  const Eigen::Matrix<double, 2, 3> by_error = level.transpose() * cross_matrix(along) / strength;
  const Eigen::Matrix2d of_felt =
      by_error * felt.covariance.topLeftCorner<3, 3>() * by_error.transpose();
  const Eigen::Matrix2d of_lean = level.transpose() * lean * level;
  const Eigen::LLT<Eigen::Matrix2d> expected(of_felt + of_lean);
  const Eigen::Vector2d pull = expected.solve(angle);
  if (angle.dot(pull) > kLeanLimit) return std::nullopt;
  return exp_so3(level * (of_lean * pull));
}

void level_about(Map& map, const Pose& T_map_tag, const Eigen::Matrix3d& turn,
                 const Eigen::Vector3d& down, const InertialNoise& inertial) {
  const auto felt = fit_gravity(map, inertial);
  if (!felt) return;
  const Eigen::Matrix3d R = T_map_tag.rotation.toRotationMatrix();
  const Eigen::Matrix3d lean = R * turn * R.transpose() + mean_turn(map);
  const auto likeliest = levelling_turn(*felt, down, lean);
  if (!likeliest) return;
  const Eigen::Vector3d& pivot = T_map_tag.translation;
  move_map(map, {*likeliest, pivot - *likeliest * pivot});
  const Eigen::Matrix3d along = down * down.transpose();
  MapGravity world{kStandardGravity * down, felt->accelerometer_bias};
  world.by_world = true;
  world.covariance.setZero();
  world.covariance.topLeftCorner<3, 3>() =
      std::pow(kVertical * kStandardGravity, 2) * (Eigen::Matrix3d::Identity() - along) +
      std::pow(kGravitySpread, 2) * along;
  world.covariance.bottomRightCorner<3, 3>() =
      std::pow(inertial.accelerometer.bias, 2) * Eigen::Matrix3d::Identity();
  map.gravity() = world;
}

}  // namespace vinebench::slam
