// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "slam/odometry/wheel_odometry.h"
#include "tests/support/synthetic_aisle.h"

namespace vinebench::test {

/// Landmarks of the aisle: more than 100 in view of each pair, and fast.
inline constexpr int kLandmarks = 1500;

/// Drives along x, swaying a little in heading; 0.3 m/s where a frame is 0.02 m.
inline Pose driving(std::int64_t frame, double step = 0.02) {
  const double x = step * static_cast<double>(frame);
  return {exp_so3({0, 0, 0.1 * std::sin(2.0 * x)}), {x, 0.05 * std::sin(x), 0}};
}

/// Largest position error against the truth of the same frame, both relative to the first one, m.
inline double worst_error(const Trajectory& estimate, const std::vector<Pose>& truth) {
  double worst = 0;
  for (const StampedPose& at : estimate) {
    const auto frame = static_cast<std::size_t>(std::lround(to_seconds(at.stamp) * 15));
    const Pose moved = estimate.front().pose.inverse() * at.pose;
    const Pose moved_truth = truth.front().inverse() * truth[frame];
    worst = std::max(worst, (moved.translation - moved_truth.translation).norm());
  }
  return worst;
}

/// Wheel readings of a frame's motion with the given slip.
inline slam::WheelStep wheels(std::int64_t frame, double slip) {
  Pose step = driving(frame - 1).inverse() * driving(frame);
  step.translation *= 1 + slip;
  return {step, 1.0 / 15};
}

}  // namespace vinebench::test
