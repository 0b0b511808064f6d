// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/odometry/dead_reckoning.h"

#include <cmath>

namespace vinebench::slam {

void DeadReckoning::reset() {
  frames_ = 0;
  seconds_on_velocity_ = 0;
  way_ = 0;
  turn_ = 0;
}

Pose DeadReckoning::advance(const std::optional<Pose>& wheels, const Vector6d& velocity,
                            double dt) {
  ++frames_;
  if (wheels) {
    way_ += wheels->translation.norm();
    turn_ += angle_of(wheels->rotation);
    return *wheels;
  }
  seconds_on_velocity_ += dt;
  return step_of(velocity * dt);
}

double DeadReckoning::sigma_rotation() const {
  const double t = seconds_on_velocity_;
  return std::hypot(config_.wheel_turn * (way_ + turn_), 0.5 * config_.turn_acceleration * t * t);
}

double DeadReckoning::sigma_position() const {
  const double t = seconds_on_velocity_;
  // The heading's error grows along the way: on average half of it acts on all of the way.
  const double aside = 0.5 * config_.wheel_turn * (way_ + turn_) * way_;
  return std::hypot(config_.wheel_slip * way_, aside, 0.5 * config_.acceleration * t * t);
}

Matrix6d DeadReckoning::covariance() const {
  // Floors: what a standing body's encoders and frame times leave open.
  constexpr double kPosition = 1e-3;  // m
  constexpr double kRotation = 1e-3;  // rad
  Vector6d variance;
  variance.head<3>().setConstant(std::pow(std::hypot(sigma_position(), kPosition), 2));
  variance.tail<3>().setConstant(std::pow(std::hypot(sigma_rotation(), kRotation), 2));
  return variance.asDiagonal();
}

}  // namespace vinebench::slam
