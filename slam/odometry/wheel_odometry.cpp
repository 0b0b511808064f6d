// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/odometry/wheel_odometry.h"

namespace vinebench::slam {

Pose WheelOdometry::step_between(const WheelSample& from, const WheelSample& to) const {
  std::array<double, 4> rolled{};  // m; front-left, front-right, rear-left, rear-right
  for (std::size_t i = 0; i < rolled.size(); ++i) {
    rolled[i] = wheels_.radius * (to.angle[i] - from.angle[i]);
  }
  const auto [fl, fr, rl, rr] = rolled;
  const double turn = (-fl + fr - rl + rr) / (4 * (wheels_.half_track + wheels_.half_wheelbase));
  const Eigen::Vector3d way((fl + fr + rl + rr) / 4, (-fl + fr + rl - rr) / 4, 0);
  // Half of the turn is done when half of the way is.
  return {exp_so3({0, 0, turn}), exp_so3({0, 0, turn / 2}) * way};
}

std::optional<WheelStep> WheelOdometry::step(const std::vector<WheelSample>& readings) {
  std::optional<WheelStep> motion;
  for (const WheelSample& reading : readings) {
    if (last_) {
      const Pose step = step_between(*last_, reading);
      motion =
          motion ? WheelStep{motion->T_before_now * step, motion->seconds} : WheelStep{step, 0};
      motion->seconds += to_seconds(reading.stamp - last_->stamp);
    }
    last_ = reading;
  }
  return motion;
}

}  // namespace vinebench::slam
