// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/odometry/wheel_drift.h"

#include "core/geometry/step_covariance.h"

namespace vinebench::slam {
namespace {

Matrix6d by_rates(const WheelWay& way, const Vector6d& variances) {
  return way.by_rate * variances.asDiagonal() * way.by_rate.transpose();
}

}  // namespace

void WheelWay::roll(const Pose& T_before_now) {
  const double rolled = T_before_now.translation.norm() + angle_of(T_before_now.rotation);
  T_start_now = T_start_now * T_before_now;
  by_rate = carried_step(T_before_now) * by_rate;
  by_rate.diagonal().array() += rolled;
  length += rolled;
}

void WheelDrift::roll(const Pose& T_before_now, const WheelErrors& errors) {
  whole_.roll(T_before_now);
  stretch_.roll(T_before_now);
  of_ended_ = carry_covariance(of_ended_, T_before_now);
  if (stretch_.length < kWheelStretch) return;
  of_ended_ += by_rates(stretch_, errors.passing);
  stretch_ = {};
}

Matrix6d WheelDrift::covariance(const WheelErrors& errors) const {
  return by_rates(whole_, errors.lasting) + of_ended_ + by_rates(stretch_, errors.passing);
}

}  // namespace vinebench::slam
