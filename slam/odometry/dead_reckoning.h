// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "core/config/config_field.h"
#include "core/geometry/pose.h"
#include "slam/odometry/inertial_filter.h"
#include "slam/odometry/map_gravity.h"
#include "slam/odometry/wheel_accuracy.h"
#include "slam/odometry/wheel_odometry.h"

namespace vinebench::slam {

/// What is known of the body's motion while no camera sees anything.
struct DeadReckoningConfig {
  std::optional<MecanumWheels> wheels;  ///< without, the last velocity is kept
  /// Share of the way, standard deviation: gates allow for it; a pose's covariance goes by how
  /// wrong the wheels were while the cameras saw.
  double wheel_slip = 0.05;
  double wheel_turn = 0.05;        ///< rad a m of the way and a rad turned, likewise
  double acceleration = 0.5;       ///< m/s^2, that a kept velocity does not know of
  double turn_acceleration = 0.5;  ///< rad/s^2, likewise
  double max_sigma = 1.0;          ///< m; less certain than this the body is lost

  template <class Archive>
  void serialize(Archive& archive) {
    archive("wheels", wheels);
    archive("wheel_slip", wheel_slip, Range::positive());
    archive("wheel_turn", wheel_turn, Range::positive());
    archive("acceleration", acceleration, Range::positive());
    archive("turn_acceleration", turn_acceleration, Range::positive());
    archive("max_sigma", max_sigma, Range::positive());
  }
};

/// An odometry gap: what was done in it, and how uncertain that is. Where an inertial unit takes
/// part, that is what its filter says.
class DeadReckoning {
 public:
  explicit DeadReckoning(const DeadReckoningConfig& config,
                         const std::optional<InertialNoise>& inertial = {},
                         const std::optional<WheelFusionConfig>& wheels = {});

  /// A frame's inertial readings and the wheels' motion, before it is looked at.
  void arrive(const std::vector<ImuSample>& imu, const std::optional<WheelStep>& wheels,
              Stamp stamp);

  /// Where the body is by its inertial unit, if one takes part and knows.
  std::optional<Pose> T_map_body() const;

  /// Sight is back, or begins.
  void reset();

  /// Cameras saw the body there, in the frame that has arrived: step of step_of.
  void see(const Pose& T_map_body, const Matrix6d& covariance);

  /// The body is there, and moves on as before.
  void place(const Pose& T_map_body);

  /// Poses in the map were corrected, the body's by that: gravity stays as it lies in the map.
  void correct(const Pose& T_new_old);

  /// The map's gravity as something else knows it better, m/s^2.
  void believe_gravity(const Eigen::Vector3d& gravity);

  /// One more frame without sight, `dt` s after the one before. Returns T_before_now: by the wheels
  /// where there are any, else by the velocity (body frame; m/s, rad/s) of the last seen motion.
  Pose advance(const std::optional<WheelStep>& wheels, const Vector6d& velocity, double dt);

  /// The body's velocity by its inertial unit (body frame; m/s, rad/s), if one takes part.
  std::optional<Vector6d> velocity() const;

  /// What the inertial unit measured since the last call, if one takes part.
  std::optional<PreintegratedMotion> take_motion();

  /// Gravity by the inertial unit, if one takes part and knows.
  std::optional<MapGravity> gravity() const;

  bool active() const { return frames_ > 0; }
  int frames() const { return frames_; }
  /// By what was told of the wheels, which may begin to slip now.
  double sigma_position() const;  ///< m
  double sigma_rotation() const;  ///< rad
  bool is_lost() const { return sigma_position() > config_.max_sigma; }

  /// Covariance of the motion since then, in the step of step_of: as wrong as the wheels were when
  /// the cameras last saw, and at worst, which is what was told of them.
  Matrix6d covariance() const;
  Matrix6d worst_covariance() const;

 private:
  bool is_inertial() const { return inertial_ && inertial_->running(); }
  double sigma_of_velocity(double acceleration) const;

  DeadReckoningConfig config_;
  std::optional<InertialFilter> inertial_;
  WheelAccuracy wheel_accuracy_;
  WheelDrift drift_;
  int frames_ = 0;
  double seconds_on_velocity_ = 0;
  double way_ = 0;   ///< m, by the wheels
  double turn_ = 0;  ///< rad, by the wheels
};

}  // namespace vinebench::slam
