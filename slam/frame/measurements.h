// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "slam/camera/estimator_rig.h"
#include "slam/camera/measurement_noise.h"
#include "slam/camera/stereo_camera.h"
#include "slam/factors/reprojection.h"
#include "slam/frame/frame_features.h"

namespace vinebench::slam {

/// The measurement that a feature is: its pixel, its stereo match where it has one, its noise.
PixelMeasurement measure(const StereoView& view, int feature, const MeasurementNoise& noise);

/// The body's pose when a row of a view's image was exposed, by the image's own stamp, the pair's
/// times as they were found, and the frame's velocity.
Pose row_pose(const FrameFeatures& frame, std::size_t view, double row, const Pose& T_map_body,
              const EstimatorRig& rig);
/// Of the row in the middle.
Pose view_pose(const FrameFeatures& frame, std::size_t view, const Pose& T_map_body,
               const EstimatorRig& rig);
/// Of each view.
std::vector<Pose> view_poses(const FrameFeatures& frame, const Pose& T_map_body,
                             const EstimatorRig& rig);

/// Where a landmark of the feature begins, m along the optical axis: its stereo depth, or that of a
/// match farther than those, up to so many baselines. Nothing without either.
std::optional<double> first_depth(const StereoCameraModel& camera, double far_depth_baselines,
                                  const StereoView& view, std::size_t feature);

/// Where a depth along the optical axis, m, puts the feature in the map.
Eigen::Vector3d stereo_point(const FrameFeatures& frame, std::size_t view, int feature,
                             double depth, const Pose& T_map_body, const EstimatorRig& rig);

/// Depths of a view as the camera's disparity offset makes them, none beyond so many baselines;
/// unchanged where there is no offset.
void correct_depths(const StereoCameraModel& camera, double max_depth_baselines, StereoView& view);

/// Gives matches beyond the limit their depth where fewer than StereoConfig::few_near lie within
/// it: nothing else tells then how far the body moves.
void reach_farther(const StereoCameraModel& camera, const StereoConfig& config, StereoView& view);

}  // namespace vinebench::slam
