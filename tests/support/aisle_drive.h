// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
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

/// What both frames see.
inline std::shared_ptr<slam::FrameFeatures> both(slam::FrameFeatures a,
                                                 const slam::FrameFeatures& b,
                                                 const slam::StereoRig& rig) {
  for (std::size_t v = 0; v < a.views.size(); ++v) {
    slam::Features& features = a.views[v].features;
    const slam::Features& more = b.views[v].features;
    features.keypoints.insert(features.keypoints.end(), more.keypoints.begin(),
                              more.keypoints.end());
    features.descriptors.insert(features.descriptors.end(), more.descriptors.begin(),
                                more.descriptors.end());
    a.views[v].stereo.insert(a.views[v].stereo.end(), b.views[v].stereo.begin(),
                             b.views[v].stereo.end());
    a.views[v].grid =
        slam::FeatureGrid(features.keypoints, rig.pairs[v].lens.width, rig.pairs[v].lens.height);
  }
  return std::make_shared<slam::FrameFeatures>(std::move(a));
}

}  // namespace vinebench::test
