// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/odometry/dead_reckoning.h"

#include <cmath>

namespace vinebench::slam {

DeadReckoning::DeadReckoning(const DeadReckoningConfig& config,
                             const std::optional<InertialNoise>& inertial,
                             const std::optional<WheelFusionConfig>& wheels)
    : config_(config) {
  if (inertial) inertial_.emplace(*inertial, wheels);
}

void DeadReckoning::arrive(const std::vector<ImuSample>& imu,
                           const std::optional<WheelStep>& wheels, Stamp stamp) {
  if (inertial_) inertial_->advance(imu, wheels, stamp);
}

std::optional<Pose> DeadReckoning::T_map_body() const {
  if (!is_inertial()) return std::nullopt;
  return inertial_->T_map_body();
}

std::optional<Vector6d> DeadReckoning::velocity() const {
  if (!is_inertial()) return std::nullopt;
  return inertial_->velocity();
}

std::optional<PreintegratedMotion> DeadReckoning::take_motion() {
  return inertial_ ? inertial_->take_motion() : std::nullopt;
}

std::optional<MapGravity> DeadReckoning::gravity() const {
  if (!is_inertial()) return std::nullopt;
  return inertial_->map_gravity();
}

void DeadReckoning::see(const Pose& T_map_body, const Matrix6d& covariance) {
  if (inertial_) inertial_->see(T_map_body, covariance);
}

void DeadReckoning::place(const Pose& T_map_body) {
  if (is_inertial()) inertial_->place(T_map_body);
}

void DeadReckoning::correct(const Pose& T_new_old) {
  if (is_inertial()) inertial_->place(T_new_old * inertial_->T_map_body());
}

void DeadReckoning::believe_gravity(const Eigen::Vector3d& gravity) {
  if (is_inertial()) inertial_->believe_gravity(gravity);
}

void DeadReckoning::reset() {
  frames_ = 0;
  seconds_on_velocity_ = 0;
  way_ = 0;
  turn_ = 0;
}

Pose DeadReckoning::advance(const std::optional<WheelStep>& wheels, const Vector6d& velocity,
                            double dt) {
  ++frames_;
  if (wheels) {
    way_ += wheels->T_before_now.translation.norm();
    turn_ += angle_of(wheels->T_before_now.rotation);
    return wheels->T_before_now;
  }
  seconds_on_velocity_ += dt;
  return step_of(velocity * dt);
}

double DeadReckoning::sigma_rotation() const {
  if (!active()) return 0;
  if (is_inertial()) return std::sqrt(inertial_->covariance().bottomRightCorner<3, 3>().trace());
  const double t = seconds_on_velocity_;
  return std::hypot(config_.wheel_turn * (way_ + turn_), 0.5 * config_.turn_acceleration * t * t);
}

double DeadReckoning::sigma_position() const {
  if (!active()) return 0;
  if (is_inertial()) return std::sqrt(inertial_->covariance().topLeftCorner<3, 3>().trace());
  const double t = seconds_on_velocity_;
  // The heading's error grows along the way: on average half of it acts on all of the way.
  const double aside = 0.5 * config_.wheel_turn * (way_ + turn_) * way_;
  return std::hypot(config_.wheel_slip * way_, aside, 0.5 * config_.acceleration * t * t);
}

Matrix6d DeadReckoning::covariance() const {
  // Floors: what a standing body's encoders and frame times leave open.
  constexpr double kPosition = 1e-3;  // m
  constexpr double kRotation = 1e-3;  // rad
  if (active() && is_inertial()) {
    Matrix6d covariance = inertial_->covariance();
    covariance.diagonal().head<3>().array() += kPosition * kPosition;
    covariance.diagonal().tail<3>().array() += kRotation * kRotation;
    return covariance;
  }
  Vector6d variance;
  variance.head<3>().setConstant(std::pow(std::hypot(sigma_position(), kPosition), 2));
  variance.tail<3>().setConstant(std::pow(std::hypot(sigma_rotation(), kRotation), 2));
  return variance.asDiagonal();
}

}  // namespace vinebench::slam
