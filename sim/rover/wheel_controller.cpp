// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/rover/wheel_controller.h"

#include <algorithm>
#include <cmath>

namespace vinebench::sim {

WheelArray MecanumDrive::wheel_speeds(const Eigen::Vector3d& twist) const {
  const double forward = twist.x();
  const double left = twist.y();
  const double turn = (half_track + half_wheelbase) * twist.z();
  return {(forward - left - turn) / wheel_radius, (forward + left + turn) / wheel_radius,
          (forward + left - turn) / wheel_radius, (forward - left + turn) / wheel_radius};
}

Eigen::Vector3d MecanumDrive::body_motion(const WheelArray& wheels) const {
  const auto& [front_left, front_right, rear_left, rear_right] = wheels;
  const double quarter = wheel_radius / 4;
  return {quarter * (front_left + front_right + rear_left + rear_right),
          quarter * (-front_left + front_right + rear_left - rear_right),
          quarter * (-front_left + front_right - rear_left + rear_right) /
              (half_track + half_wheelbase)};
}

double SpeedLoop::torque(double wanted, double measured, double dt) {
  // rad/s: below this the friction's sign is faded out, to avoid chattering around standstill.
  constexpr double kBarelyTurning = 0.05;
  const double error = wanted - measured;
  const double torque = config_.proportional * error + integral_ +
                        config_.friction * std::tanh(wanted / kBarelyTurning);
  const double limited = std::clamp(torque, -config_.max_torque, config_.max_torque);
  if (limited == torque || error * torque < 0) {
    integral_ += config_.integral * error * dt;
  }
  return limited;
}

}  // namespace vinebench::sim
