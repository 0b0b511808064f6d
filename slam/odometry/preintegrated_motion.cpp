// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/odometry/preintegrated_motion.h"

#include "core/geometry/pose.h"

namespace vinebench::slam {

void PreintegratedMotion::add(const Eigen::Vector3d& turn_rate, const Eigen::Vector3d& force,
                              const Eigen::Vector3d& bias, double dt) {
  const Eigen::Matrix3d R = (turn * exp_so3(turn_rate * (dt / 2))).toRotationMatrix();
  const Eigen::Vector3d acceleration = R * force;
  position += velocity * dt + acceleration * (dt * dt / 2);
  velocity += acceleration * dt;
  position_by_bias += velocity_by_bias * dt - R * (dt * dt / 2);
  velocity_by_bias -= R * dt;
  turn = (turn * exp_so3(turn_rate * dt)).normalized();
  accelerometer_bias = (accelerometer_bias * seconds + bias * dt) / (seconds + dt);
  seconds += dt;
}

}  // namespace vinebench::slam
