// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/frame/measurements.h"

#include <cmath>

namespace vinebench::slam {
namespace {

/// m along the optical axis, of a match that may have none; not above 0 without a match.
double depth_by_disparity(const StereoCameraModel& camera, const StereoView& view,
                          std::size_t feature) {
  const float x_right = view.stereo[feature].x_right;
  if (x_right < 0) return -1;
  const Keypoint& keypoint = view.features.keypoints[feature];
  return camera.depth_of({keypoint.x, keypoint.y}, static_cast<double>(keypoint.x - x_right));
}

}  // namespace

PixelMeasurement measure(const StereoView& view, int feature, const MeasurementNoise& noise) {
  const auto f = static_cast<std::size_t>(feature);
  const Keypoint& keypoint = view.features.keypoints[f];
  PixelMeasurement m;
  m.pixel = {keypoint.x, keypoint.y};
  m.sigma = m.right_sigma = noise.level_scales[static_cast<std::size_t>(keypoint.level)];
  if (view.is_placed(f)) {
    m.right_sigma *= std::hypot(noise.placed_sigma, noise.placed_disparity_sigma);
    m.sigma *= noise.placed_sigma;
    m.tolerance = noise.placed_tolerance;
  }
  if (view.stereo[f].depth > 0) m.right_x = view.stereo[f].x_right;
  m.late = view.late;
  return m;
}

Pose row_pose(const FrameFeatures& frame, std::size_t view, double row, const Pose& T_map_body,
              const EstimatorRig& rig) {
  const double late = frame.views[view].late + rig.left_cameras[view].time_of(row);
  return late == 0 ? T_map_body : T_map_body * step_of(frame.velocity * late);
}

Pose view_pose(const FrameFeatures& frame, std::size_t view, const Pose& T_map_body,
               const EstimatorRig& rig) {
  return row_pose(frame, view, 0.5 * rig.left_cameras[view].lens.height, T_map_body, rig);
}

std::vector<Pose> view_poses(const FrameFeatures& frame, const Pose& T_map_body,
                             const EstimatorRig& rig) {
  std::vector<Pose> poses;
  for (std::size_t v = 0; v < frame.views.size(); ++v) {
    poses.push_back(view_pose(frame, v, T_map_body, rig));
  }
  return poses;
}

Eigen::Vector3d stereo_point(const FrameFeatures& frame, std::size_t view, int feature,
                             double depth, const Pose& T_map_body, const EstimatorRig& rig) {
  const auto f = static_cast<std::size_t>(feature);
  const Keypoint& keypoint = frame.views[view].features.keypoints[f];
  const Eigen::Vector3d ray = rig.left_cameras[view].lens.unproject({keypoint.x, keypoint.y});
  const Eigen::Vector3d p_cam = ray * depth;
  const Pose T_map_then = row_pose(frame, view, keypoint.y, T_map_body, rig);
  return T_map_then * (rig.T_body_cams[view] * p_cam);
}

std::optional<double> first_depth(const StereoCameraModel& camera, double far_depth_baselines,
                                  const StereoView& view, std::size_t feature) {
  const StereoMatch& match = view.stereo[feature];
  if (match.depth > 0) return static_cast<double>(match.depth);
  const double depth = depth_by_disparity(camera, view, feature);
  if (depth > 0 && depth < far_depth_baselines * camera.baseline) return depth;
  return std::nullopt;
}

void correct_depths(const StereoCameraModel& camera, double max_depth_baselines, StereoView& view) {
  if (!camera.has_disparity_errors()) return;
  for (std::size_t f = 0; f < view.stereo.size(); ++f) {
    StereoMatch& match = view.stereo[f];
    if (match.x_right < 0) continue;
    const double depth = depth_by_disparity(camera, view, f);
    const bool near = depth > 0 && depth < max_depth_baselines * camera.baseline;
    match.depth = near ? static_cast<float>(depth) : -1.0F;
  }
}

void reach_farther(const StereoCameraModel& camera, const StereoConfig& config, StereoView& view) {
  if (count_with_depth(view.stereo) >= config.few_near) return;
  for (std::size_t f = 0; f < view.stereo.size(); ++f) {
    if (const auto depth = first_depth(camera, config.far_depth_baselines, view, f)) {
      view.stereo[f].depth = static_cast<float>(*depth);
    }
  }
}

}  // namespace vinebench::slam
