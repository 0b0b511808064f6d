// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/geometry/pose.h"

#include <cmath>

namespace vinebench {

Eigen::Matrix4d Pose::matrix() const {
  Eigen::Matrix4d m = Eigen::Matrix4d::Identity();
  m.topLeftCorner<3, 3>() = rotation.toRotationMatrix();
  m.topRightCorner<3, 1>() = translation;
  return m;
}

Eigen::Quaterniond exp_so3(const Eigen::Vector3d& rotation_vector) {
  const double angle = rotation_vector.norm();
  // Below 1e-6 rad the next term of the series, angle^2 / 24, is under the double's resolution.
  const double sinc = angle < 1e-6 ? 0.5 : std::sin(0.5 * angle) / angle;
  Eigen::Quaterniond q;
  q.w() = std::cos(0.5 * angle);
  q.vec() = sinc * rotation_vector;
  return q.normalized();
}

Eigen::Vector3d log_so3(const Eigen::Quaterniond& rotation) {
  const double sign = rotation.w() < 0 ? -1.0 : 1.0;
  const Eigen::Vector3d axis = sign * rotation.vec();
  const double sine = axis.norm();
  if (sine < 1e-9) return 2.0 * axis;
  return axis * (2.0 * std::atan2(sine, sign * rotation.w()) / sine);
}

Pose step_of(const Vector6d& step) {
  return {exp_so3(step.tail<3>()), step.head<3>()};
}

Eigen::Quaterniond from_roll_pitch_yaw(const Eigen::Vector3d& rpy) {
  return Eigen::AngleAxisd(rpy.z(), Eigen::Vector3d::UnitZ()) *
         Eigen::AngleAxisd(rpy.y(), Eigen::Vector3d::UnitY()) *
         Eigen::AngleAxisd(rpy.x(), Eigen::Vector3d::UnitX());
}

double yaw_of(const Eigen::Quaterniond& rotation) {
  const Eigen::Vector3d x_axis = rotation * Eigen::Vector3d::UnitX();
  return std::atan2(x_axis.y(), x_axis.x());
}

Pose interpolate(const Pose& a, const Pose& b, double fraction) {
  return {a.rotation.slerp(fraction, b.rotation).normalized(),
          (1.0 - fraction) * a.translation + fraction * b.translation};
}

bool is_rotation(const Eigen::Matrix3d& R, double tolerance) {
  return (R * R.transpose()).isIdentity(tolerance) && R.determinant() > 0;
}

double angle_of(const Eigen::Quaterniond& rotation) {
  return log_so3(rotation).norm();
}

}  // namespace vinebench
