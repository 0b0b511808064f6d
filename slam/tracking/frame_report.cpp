// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/tracking/frame_report.h"

#include "slam/camera/rectification.h"
#include "slam/frame/measurements.h"

namespace vinebench::slam {

Estimate report_of(const TrackedFrame& tracked, const StereoRig& rig, TrackingStatus status) {
  const FrameFeatures& frame = *tracked.frame;
  Estimate estimate;
  estimate.stamp = frame.stamp;
  estimate.status = status;
  estimate.tags = frame.tags;
  estimate.cameras.resize(rig.cameras.size());
  for (std::size_t p = 0; p < rig.pairs.size(); ++p) {
    const RectifiedPair& pair = rig.pairs[p];
    const StereoView& view = frame.views[p];
    CameraCounts& left = estimate.cameras[static_cast<std::size_t>(pair.left_camera)];
    left.features = static_cast<int>(view.features.size());
    left.stereo = count_with_depth(view.stereo);
    left.matches = tracked.motion.matches_per_view[p];
    left.inliers = tracked.motion.inliers_per_view[p];
    estimate.cameras[static_cast<std::size_t>(pair.right_camera)].features = left.stereo;
  }
  return estimate;
}

void SupportingFeatures::keep(const TrackedFrame& tracked) {
  pixels_.assign(tracked.tracked ? tracked.associations.size() : 0, {});
  for (std::size_t v = 0; v < pixels_.size(); ++v) {
    const std::vector<Keypoint>& keypoints = tracked.frame->views[v].features.keypoints;
    for (std::size_t i = 0; i < tracked.associations[v].size(); ++i) {
      if (tracked.associations[v][i] < 0) continue;
      pixels_[v].emplace_back(keypoints[i].x, keypoints[i].y);
    }
  }
}

std::vector<SupportingFeature> SupportingFeatures::in_images(const StereoRig& rig) const {
  std::vector<SupportingFeature> features;
  for (std::size_t v = 0; v < pixels_.size(); ++v) {
    const RectifiedPair& pair = rig.pairs[v];
    for (const Eigen::Vector2f& at : pixels_[v]) {
      const Eigen::Vector2d pixel = at.cast<double>();
      features.push_back({pair.left_camera,
                          pair.rectification ? pair.rectification->in_left_image(pixel) : pixel});
    }
  }
  return features;
}

}  // namespace vinebench::slam
