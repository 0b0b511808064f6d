// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/geometry/pose.h"

namespace vinebench::slam {

/// Wheels are wrong at a rate: so many m and rad, in the axes of the body, a m of the way or a rad
/// turned. Variances of the six rates, in the order of step_of.
struct WheelErrors {
  Vector6d lasting = Vector6d::Zero();  ///< the same all the way: a radius, a ground that yields
  Vector6d passing = Vector6d::Zero();  ///< anew with each stretch: a bump
};

/// The way of these errors' stretches, m and rad.
inline constexpr double kWheelStretch = 0.25;

/// A way by the wheels.
struct WheelWay {
  Pose T_start_now;
  double length = 0;  ///< m of the way and rad turned
  /// The step of T_start_now by a unit of each rate that lasts all the way, to first order.
  Matrix6d by_rate = Matrix6d::Zero();

  void roll(const Pose& T_before_now);
};

/// How wrong a way by the wheels may be.
class WheelDrift {
 public:
  void roll(const Pose& T_before_now, const WheelErrors& errors);

  /// Of the whole way's motion, in the step of step_of.
  Matrix6d covariance(const WheelErrors& errors) const;

 private:
  WheelWay whole_;
  WheelWay stretch_;                      ///< the last one, not ended
  Matrix6d of_ended_ = Matrix6d::Zero();  ///< covariance by what passed in the ended stretches
};

}  // namespace vinebench::slam
