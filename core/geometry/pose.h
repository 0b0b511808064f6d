// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace vinebench {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

/// A rigid transform. Named T_a_b, it takes coordinates in b to coordinates in a:
/// p_a = T_a_b * p_b, and T_a_c = T_a_b * T_b_c.
struct Pose {
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();  ///< unit quaternion, R_a_b
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();         ///< p of b's origin in a, m

  Pose operator*(const Pose& other) const {
    return {(rotation * other.rotation).normalized(), rotation * other.translation + translation};
  }
  Eigen::Vector3d operator*(const Eigen::Vector3d& point) const {
    return rotation * point + translation;
  }
  Pose inverse() const {
    const Eigen::Quaterniond back = rotation.conjugate();
    return {back, -(back * translation)};
  }
  Eigen::Matrix4d matrix() const;
};

/// Rotation vector (rad) to quaternion and back; exact at and near zero.
Eigen::Quaterniond exp_so3(const Eigen::Vector3d& rotation_vector);
Eigen::Vector3d log_so3(const Eigen::Quaterniond& rotation);

/// A small motion (rho, theta) in the body frame as a pose: m, then a rotation vector, rad.
Pose step_of(const Vector6d& step);

/// Roll about x, then pitch about y, then yaw about z of the fixed axes (R = Rz Ry Rx), rad.
Eigen::Quaterniond from_roll_pitch_yaw(const Eigen::Vector3d& rpy);

/// Heading of the x axis in the x-y plane, rad in (-pi, pi].
double yaw_of(const Eigen::Quaterniond& rotation);

/// Interpolates between two poses: linear in translation, slerp in rotation.
Pose interpolate(const Pose& a, const Pose& b, double fraction);

/// Whether R R^T is the identity to `tolerance` and R does not mirror; not if it has a NaN.
bool is_rotation(const Eigen::Matrix3d& R, double tolerance);

/// Angle of the rotation, rad in [0, pi].
double angle_of(const Eigen::Quaterniond& rotation);

}  // namespace vinebench
