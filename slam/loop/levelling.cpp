// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/loop/levelling.h"

#include <Eigen/Cholesky>

#include "core/geometry/cross_matrix.h"
#include "slam/loop/loop_correction.h"

namespace vinebench::slam {
namespace {

/// 99.9 % of the chi-square distribution with two degrees of freedom.
constexpr double kLeanLimit = 13.82;

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

void turn_about(Map& map, const Eigen::Vector3d& pivot, const Eigen::Quaterniond& turn) {
  const Pose T_new_old{turn, pivot - turn * pivot};
  move_from(map, 0, T_new_old);
  for (MapTag& tag : map.tags()) {
    if (!tag.fixed) tag.T_map_tag = T_new_old * tag.T_map_tag;
  }
  if (!map.gravity()) return;
  MapGravity& known = *map.gravity();
  known.gravity = turn * known.gravity;
  Matrix6d carried = Matrix6d::Identity();
  carried.topLeftCorner<3, 3>() = turn.toRotationMatrix();
  known.covariance = carried * known.covariance * carried.transpose();
}

}  // namespace vinebench::slam
