// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>

namespace vinebench::sim {

/// Front-left, front-right, rear-left, rear-right.
using WheelArray = std::array<double, 4>;

/// Four mecanum wheels whose upper rollers form an X seen from above. No slip assumed.
struct MecanumDrive {
  double wheel_radius = 0.10;    ///< m
  double half_track = 0.19;      ///< m, body centre to wheel centre along y
  double half_wheelbase = 0.15;  ///< m, along x

  /// Speeds of the wheels (rad/s) for a body twist: forward, left (m/s), turn to the left (rad/s).
  WheelArray wheel_speeds(const Eigen::Vector3d& twist) const;

  /// The body's motion (forward, left, turn to the left) for these wheel angles; the least-squares
  /// solution. Wheel speeds give a twist likewise.
  Eigen::Vector3d body_motion(const WheelArray& wheels) const;
};

/// Parameters of a wheel's speed loop, on the wheel's side of the gearbox.
struct SpeedLoopConfig {
  double proportional = 3;  ///< Nm per rad/s
  double integral = 20;     ///< Nm per rad
  double friction = 0.1;    ///< Nm, fed forward
  double max_torque = 5;    ///< Nm
};

/// PI loop on a wheel's speed with friction feed-forward. The integral is held while the torque is
/// at its limit and the error would increase it (anti-windup).
class SpeedLoop {
 public:
  explicit SpeedLoop(const SpeedLoopConfig& config) : config_(config) {}

  /// Torque (Nm) for the next `dt` (s); speeds in rad/s.
  double torque(double wanted, double measured, double dt);

 private:
  SpeedLoopConfig config_;
  double integral_ = 0;  ///< Nm
};

}  // namespace vinebench::sim
