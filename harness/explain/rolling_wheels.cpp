// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/explain/rolling_wheels.h"

#include <algorithm>

namespace vinebench::harness {

void RollingWheels::replace(std::vector<WheelSample>& readings, const Trajectory& path) {
  path_.insert(path_.end(), path.begin(), path.end());
  for (WheelSample& reading : readings) {
    if (last_ && !path_.empty()) {
      const Pose step = at(last_->stamp).inverse() * at(reading.stamp);
      const sim::WheelArray turned =
          drive_.wheel_speeds({step.translation.x(), step.translation.y(), yaw_of(step.rotation)});
      const double dt = to_seconds(reading.stamp - last_->stamp);
      for (std::size_t i = 0; i < turned.size(); ++i) {
        reading.angle[i] = last_->angle[i] + turned[i];
        reading.velocity[i] = turned[i] / dt;
      }
    }
    last_ = reading;
  }
  if (!last_) return;
  const auto needed = std::ranges::upper_bound(path_, last_->stamp, {}, &StampedPose::stamp);
  if (needed - path_.begin() > 1) path_.erase(path_.begin(), needed - 1);
}

Pose RollingWheels::at(Stamp stamp) const {
  const auto next = std::ranges::lower_bound(path_, stamp, {}, &StampedPose::stamp);
  if (next == path_.end()) return path_.back().pose;
  if (next == path_.begin() || next->stamp == stamp) return next->pose;
  const StampedPose& before = *std::prev(next);
  return interpolate(
      before.pose, next->pose,
      static_cast<double>(stamp - before.stamp) / static_cast<double>(next->stamp - before.stamp));
}

}  // namespace vinebench::harness
