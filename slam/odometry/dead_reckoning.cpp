// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/odometry/dead_reckoning.h"

#include <cmath>

#include "core/geometry/step_covariance.h"

namespace vinebench::slam {
namespace {

// Floors: what a standing body's encoders and frame times leave open.
constexpr double kPosition = 1e-3;  // m
constexpr double kRotation = 1e-3;  // rad

}  // namespace

DeadReckoning::DeadReckoning(const DeadReckoningConfig& config,
                             const std::optional<InertialNoise>& inertial,
                             const std::optional<WheelFusionConfig>& wheels)
    : config_(config), wheel_accuracy_(config.wheel_slip, config.wheel_turn) {
  if (inertial) inertial_.emplace(*inertial, wheels);
}

void DeadReckoning::arrive(const std::vector<ImuSample>& imu,
                           const std::optional<WheelStep>& wheels, Stamp stamp) {
  if (inertial_) inertial_->advance(imu, wheels, stamp);
  wheel_accuracy_.roll(wheels ? std::optional(wheels->T_before_now) : std::nullopt);
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
  wheel_accuracy_.see(T_map_body);
}

void DeadReckoning::place(const Pose& T_map_body) {
  if (is_inertial()) inertial_->place(T_map_body);
  wheel_accuracy_.interrupt();
}

void DeadReckoning::correct(const Pose& T_new_old) {
  if (is_inertial()) inertial_->place(T_new_old * inertial_->T_map_body());
  wheel_accuracy_.correct(T_new_old);
}

void DeadReckoning::believe_gravity(const Eigen::Vector3d& gravity) {
  if (is_inertial()) inertial_->believe_gravity(gravity);
}

void DeadReckoning::reset() {
  frames_ = 0;
  seconds_on_velocity_ = 0;
  way_ = 0;
  turn_ = 0;
  drift_ = {};
}

Pose DeadReckoning::advance(const std::optional<WheelStep>& wheels, const Vector6d& velocity,
                            double dt) {
  ++frames_;
  wheel_accuracy_.interrupt();
  if (wheels) {
    drift_.roll(wheels->T_before_now, wheel_accuracy_.errors());
    way_ += wheels->T_before_now.translation.norm();
    turn_ += angle_of(wheels->T_before_now.rotation);
    return wheels->T_before_now;
  }
  seconds_on_velocity_ += dt;
  return step_of(velocity * dt);
}

double DeadReckoning::sigma_of_velocity(double acceleration) const {
  return 0.5 * acceleration * seconds_on_velocity_ * seconds_on_velocity_;
}

double DeadReckoning::sigma_rotation() const {
  if (!active()) return 0;
  if (is_inertial()) return std::sqrt(inertial_->covariance().bottomRightCorner<3, 3>().trace());
  return std::hypot(config_.wheel_turn * (way_ + turn_),
                    sigma_of_velocity(config_.turn_acceleration));
}

double DeadReckoning::sigma_position() const {
  if (!active()) return 0;
  if (is_inertial()) return std::sqrt(inertial_->covariance().topLeftCorner<3, 3>().trace());
  // The heading's error grows along the way: on average half of it acts on all of the way.
  const double aside = 0.5 * config_.wheel_turn * (way_ + turn_) * way_;
  return std::hypot(config_.wheel_slip * way_, aside, sigma_of_velocity(config_.acceleration));
}

Matrix6d DeadReckoning::covariance() const {
  const Matrix6d floor = isotropic_covariance(kPosition, kRotation);
  if (!active()) return floor;
  if (is_inertial()) return inertial_->covariance() + floor;
  return drift_.covariance(wheel_accuracy_.errors()) + floor +
         isotropic_covariance(sigma_of_velocity(config_.acceleration),
                              sigma_of_velocity(config_.turn_acceleration));
}

Matrix6d DeadReckoning::worst_covariance() const {
  if (active() && is_inertial()) return covariance();
  return isotropic_covariance(std::hypot(sigma_position(), kPosition),
                              std::hypot(sigma_rotation(), kRotation));
}

}  // namespace vinebench::slam
