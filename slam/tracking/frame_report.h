// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/slam_system.h"
#include "slam/tracking/tracker.h"

namespace vinebench::slam {

/// What tracking made of a frame, without its pose: the tags in it, and counts of each camera of a
/// pair. A right camera's features are those of the left one that were found in it.
Estimate report_of(const TrackedFrame& tracked, const StereoRig& rig, TrackingStatus status);

/// The features that the last frame's pose rests on. They are put into the cameras' own images
/// when somebody asks.
class SupportingFeatures {
 public:
  /// Of a frame that is not tracked there are none.
  void keep(const TrackedFrame& tracked);

  /// In the left cameras, whose images need not be rectified.
  std::vector<SupportingFeature> in_images(const StereoRig& rig) const;

 private:
  std::vector<std::vector<Eigen::Vector2f>> pixels_;  ///< of each pair, in its rectified view
};

}  // namespace vinebench::slam
