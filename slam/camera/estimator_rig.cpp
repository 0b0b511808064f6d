// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/camera/estimator_rig.h"

#include <cmath>

namespace vinebench::slam {

EstimatorRig::EstimatorRig(const StereoRig& stereo_rig, const OrbConfig& features,
                           const RefinementConfig& refine, const StereoConfig& stereo_config)
    : rig(stereo_rig), refinement(refine), stereo(stereo_config) {
  for (const RectifiedPair& pair : rig.pairs) {
    left_cameras.push_back({pair.lens, pair.T_cam_body, pair.baseline});
    T_body_cams.push_back(pair.T_body_cam);
  }
  for (const RigCamera& camera : rig.cameras) {
    undistorted_cameras.push_back({camera.model, camera.T_body_cam.inverse(), 0});
    undistorted_cameras.back().lens.distortion = {};
  }
  for (int level = 0; level < features.levels; ++level) {
    level_scales.push_back(std::pow(features.scale, level));
  }
}

void EstimatorRig::set_disparity_offsets(const std::vector<double>& offsets) {
  for (std::size_t v = 0; v < left_cameras.size(); ++v)
    left_cameras[v].disparity_offset = offsets[v];
}

void EstimatorRig::correct_depths(std::size_t v, StereoView& view) const {
  const StereoCameraModel& camera = left_cameras[v];
  if (camera.disparity_offset == 0) return;
  for (std::size_t f = 0; f < view.stereo.size(); ++f) {
    StereoMatch& match = view.stereo[f];
    if (match.x_right < 0) continue;
    const double depth =
        camera.depth_of(static_cast<double>(view.features.keypoints[f].x - match.x_right));
    const bool near = depth > 0 && depth < stereo.max_depth_baselines * camera.baseline;
    match.depth = near ? static_cast<float>(depth) : -1.0F;
  }
}

PixelMeasurement EstimatorRig::measurement(const StereoView& view, int feature) const {
  const auto f = static_cast<std::size_t>(feature);
  const Keypoint& keypoint = view.features.keypoints[f];
  PixelMeasurement m;
  m.pixel = {keypoint.x, keypoint.y};
  m.sigma = m.right_sigma = level_scales[static_cast<std::size_t>(keypoint.level)];
  if (view.is_placed(f)) {
    m.right_sigma *= std::hypot(refinement.sigma, refinement.disparity_sigma);
    m.sigma *= refinement.sigma;
    m.tolerance = refinement.tolerance;
  }
  if (view.stereo[f].depth > 0) m.right_x = view.stereo[f].x_right;
  return m;
}

Eigen::Vector3d EstimatorRig::stereo_point(const StereoView& view, int v, int feature,
                                           const Pose& T_map_body) const {
  const auto f = static_cast<std::size_t>(feature);
  const Keypoint& keypoint = view.features.keypoints[f];
  const Eigen::Vector3d ray =
      left_cameras[static_cast<std::size_t>(v)].lens.unproject({keypoint.x, keypoint.y});
  const Eigen::Vector3d p_cam = ray * static_cast<double>(view.stereo[f].depth);
  return T_map_body * (T_body_cams[static_cast<std::size_t>(v)] * p_cam);
}

}  // namespace vinebench::slam
