// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/frame.h"
#include "core/geometry/pose.h"
#include "slam/odometry/inertial_config.h"
#include "slam/odometry/map_gravity.h"
#include "slam/odometry/preintegrated_motion.h"
#include "slam/odometry/wheel_odometry.h"

namespace vinebench::slam {

/// The body's motion by its inertial unit and wheels, held by the poses that cameras give: an
/// error-state Kalman filter (Sola, "Quaternion kinematics for the error-state Kalman filter",
/// 2017) of pose, velocity, biases, gravity in the map, and how the wheels slip. It learns while
/// cameras see, and goes on where they do not.
class InertialFilter {
 public:
  InertialFilter(const InertialNoise& inertial, const std::optional<WheelFusionConfig>& wheels)
      : noise_(inertial), wheel_config_(wheels) {}

  /// Whether a pose was seen, and readings have come.
  bool running() const { return running_; }

  /// Goes on to a frame's instant with the readings since the frame before, oldest first, and the
  /// wheels' motion since then. A frame that it is at already changes nothing.
  void advance(const std::vector<ImuSample>& readings, const std::optional<WheelStep>& wheels,
               Stamp stamp);

  /// The cameras' pose at this instant, with its covariance (step of step_of).
  void see(const Pose& T_map_body, const Matrix6d& covariance);

  /// The body is there; it moves, seen from itself, as before.
  void place(const Pose& T_map_body);

  /// The map's gravity as something else knows it better, m/s^2.
  void believe_gravity(const Eigen::Vector3d& gravity) { gravity_ = gravity; }

  /// What was measured since the last call, or since it runs; none where readings were missing.
  std::optional<PreintegratedMotion> take_motion();

  const Pose& T_map_body() const { return T_map_body_; }
  /// Of the body in its own frame, m/s and rad/s.
  Vector6d velocity() const;
  /// Of the pose, in the step of step_of.
  Matrix6d covariance() const;
  const Eigen::Vector3d& gravity() const { return gravity_; }                ///< map frame, m/s^2
  const Eigen::Vector3d& gyroscope_bias() const { return gyroscope_bias_; }  ///< rad/s
  const Eigen::Vector3d& accelerometer_bias() const { return accelerometer_bias_; }  ///< m/s^2
  MapGravity map_gravity() const;
  /// Share by which the body goes farther than its wheels say: forward, sideways.
  Eigen::Vector2d wheel_scale() const { return wheel_errors_.head<2>(); }
  /// m/s by which it goes beside that: forward, to the left.
  Eigen::Vector2d creep() const { return wheel_errors_.tail<2>(); }

 private:
  /// Where the errors' parts begin: position and velocity in the map, rotation in the body, biases,
  /// gravity, the wheels' scales and creep.
  enum Part {
    kPosition = 0,
    kVelocity = 3,
    kRotation = 6,
    kGyroscope = 9,
    kAccelerometer = 12,
    kGravity = 15,
    kWheels = 18,
    kSize = 22
  };

  void begin(const Pose& T_map_body, const Matrix6d& covariance);
  void integrate(const ImuSample& reading, Stamp until);
  void believe_wheels(const Pose& before, const WheelStep& wheels, double dt);
  void update(const Eigen::VectorXd& innovation, const Eigen::MatrixXd& H,
              const Eigen::MatrixXd& noise);

  InertialNoise noise_;
  std::optional<WheelFusionConfig> wheel_config_;
  bool running_ = false;
  Stamp stamp_ = 0;
  std::optional<ImuSample> last_reading_;
  Pose T_map_body_;
  Eigen::Vector3d velocity_ = Eigen::Vector3d::Zero();   ///< map frame, m/s
  Eigen::Vector3d turn_rate_ = Eigen::Vector3d::Zero();  ///< body frame, rad/s
  Eigen::Vector3d gyroscope_bias_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d accelerometer_bias_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d gravity_ = Eigen::Vector3d::Zero();
  Eigen::Vector4d wheel_errors_ = Eigen::Vector4d::Zero();  ///< scales, then creep
  PreintegratedMotion motion_;                              ///< since take_motion()
  bool motion_is_whole_ = true;
  Eigen::MatrixXd covariance_ = Eigen::MatrixXd::Zero(kSize, kSize);
};

}  // namespace vinebench::slam
