// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "slam/camera/measurement_noise.h"
#include "slam/camera/stereo_camera.h"
#include "slam/factors/reprojection.h"
#include "slam/frame/frame_features.h"

namespace vinebench::slam {

/// The measurement that a feature is: its pixel, its stereo match where it has one, its noise.
PixelMeasurement measure(const StereoView& view, int feature, const MeasurementNoise& noise);

/// The body's pose when a view was taken, by the frame's velocity.
Pose view_pose(const FrameFeatures& frame, std::size_t view, const Pose& T_map_body);
/// Of each view.
std::vector<Pose> view_poses(const FrameFeatures& frame, const Pose& T_map_body);

/// Where the feature's stereo depth puts it in the map. The feature must have a depth.
Eigen::Vector3d stereo_point(const StereoView& view, int feature, const PinholeCamera& lens,
                             const Pose& T_map_body, const Pose& T_body_cam);

/// Depths of a view as the camera's disparity offset makes them, none beyond so many baselines;
/// unchanged where there is no offset.
void correct_depths(const StereoCameraModel& camera, double max_depth_baselines, StereoView& view);

}  // namespace vinebench::slam
