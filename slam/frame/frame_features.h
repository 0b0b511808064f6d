// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "core/geometry/pose.h"
#include "core/slam_system.h"
#include "core/time.h"
#include "slam/features/feature_grid.h"
#include "slam/features/features.h"
#include "slam/odometry/wheel_odometry.h"
#include "slam/stereo/stereo_matcher.h"

namespace vinebench::slam {

/// What one stereo pair saw in one frame: the left camera's features with their stereo matches.
struct StereoView {
  Features features;
  std::vector<StereoMatch> stereo;  ///< of each feature
  FeatureGrid grid;
  /// Of each feature, whether it stands on the landmark's patch to a fraction of a pixel; empty
  /// where none does.
  std::vector<char> placed;

  double late = 0;  ///< s, that its left image was taken after the frame's stamp

  /// How many features at the end were not detected but followed by their landmark's patch.
  std::size_t followed = 0;

  std::size_t detected() const { return features.size() - followed; }
  bool is_placed(std::size_t feature) const { return !placed.empty() && placed[feature] != 0; }

  /// Takes the followed features out again.
  void drop_followed() {
    features.keypoints.resize(detected());
    features.descriptors.resize(features.keypoints.size());
    stereo.resize(features.keypoints.size());
    if (!placed.empty()) placed.resize(features.keypoints.size());
    followed = 0;
  }

  /// No more features will be added: gives back the room for them.
  void close() {
    features.keypoints.shrink_to_fit();
    features.descriptors.shrink_to_fit();
    stereo.shrink_to_fit();
    placed.shrink_to_fit();
  }
};

/// What a frame's images were boiled down to. Tracking places its matches more finely; after that
/// it is immutable, and shared by those who need it.
struct FrameFeatures {
  std::int64_t index = 0;
  Stamp stamp = 0;
  std::vector<StereoView> views;  ///< of each pair of the StereoRig
  std::vector<TagSighting> tags;
  Vector6d velocity = Vector6d::Zero();  ///< of the body in its own frame, m/s and rad/s
  std::optional<WheelStep> wheels;       ///< since the frame before
  std::vector<ImuSample> imu;            ///< since the frame before, oldest first
  /// Left and right pyramid of each pair, while the frame is being tracked; dropped afterwards.
  std::vector<std::vector<cv::Mat>> pyramids;
  std::vector<std::vector<cv::Mat>> right_pyramids;
};

/// Standard deviations of FrameFeatures::velocity from that of the time until the frame's last
/// image, root mean square an axis: on mecanum wheels at 10 and 15 frames a second 5 to 11 mm/s
/// along an axis and 20 to 60 mrad/s about one.
inline Vector6d error_of_velocity() {
  Vector6d error;
  error << Eigen::Vector3d::Constant(0.01), Eigen::Vector3d::Constant(0.05);
  return error;
}

/// Landmark of each feature of each view, -1 for none.
using Associations = std::vector<std::vector<int>>;

/// No feature of the frame has a landmark.
Associations no_associations(const FrameFeatures& frame);

/// The landmarks of an association, ascending, each once.
std::vector<int> landmark_ids(const Associations& associations);

}  // namespace vinebench::slam
