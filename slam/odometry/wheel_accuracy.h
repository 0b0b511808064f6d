// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "slam/odometry/wheel_drift.h"

namespace vinebench::slam {

/// How well the wheels tell the body's motion, learnt stretch by stretch from what the cameras say
/// of the same way.
class WheelAccuracy {
 public:
  /// What is believed before anything is seen: the rates' standard deviations, m and rad a m of the
  /// way or a rad turned.
  WheelAccuracy(double slip, double turn);

  /// The next frame's motion by the wheels; none where they said nothing.
  void roll(const std::optional<Pose>& T_before_now);

  /// Cameras saw the body there, in that frame.
  void see(const Pose& T_map_body);

  /// The map was corrected: poses seen so far are T_new_old * before.
  void correct(const Pose& T_new_old);

  /// What was seen before and what will be seen next are not to be compared.
  void interrupt() { T_map_start_.reset(); }

  WheelErrors errors() const;

 private:
  Vector6d told_;  ///< variances
  WheelWay way_;
  std::optional<Pose> T_map_start_;      ///< where way_ began, as it was seen
  double stretches_ = 0;                 ///< that are remembered: an old one counts less and less
  Vector6d sum_ = Vector6d::Zero();      ///< of their rates
  Vector6d squares_ = Vector6d::Zero();  ///< likewise
};

}  // namespace vinebench::slam
