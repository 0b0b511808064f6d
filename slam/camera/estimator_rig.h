// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "slam/camera/stereo_rig.h"
#include "slam/config.h"
#include "slam/factors/reprojection.h"
#include "slam/map/map.h"

namespace vinebench::slam {

/// What every stage of the estimator needs to know of cameras and noise, derived once.
struct EstimatorRig {
  EstimatorRig(const StereoRig& rig, const OrbConfig& features,
               const RefinementConfig& refinement = {}, const StereoConfig& stereo = {});

  StereoRig rig;
  std::vector<StereoCameraModel> left_cameras;         ///< left camera of each pair
  std::vector<Pose> T_body_cams;                       ///< of these
  std::vector<StereoCameraModel> undistorted_cameras;  ///< by index into Rig::cameras; no baseline
  /// Pixels of level 0 to a pixel of each pyramid level: the standard deviation of a corner there.
  std::vector<double> level_scales;
  RefinementConfig refinement;
  StereoConfig stereo;

  /// One of each camera, px.
  void set_disparity_offsets(const std::vector<double>& offsets);

  /// Depths of a view as the camera's disparity offset makes them; unchanged where it has none.
  void correct_depths(std::size_t v, StereoView& view) const;

  /// The measurement that a feature is: its pixel, its stereo match where it has one, its noise.
  PixelMeasurement measurement(const StereoView& view, int feature) const;

  /// Where the feature's stereo depth puts it in the map. The feature must have a depth.
  Eigen::Vector3d stereo_point(const StereoView& view, int v, int feature,
                               const Pose& T_map_body) const;
};

}  // namespace vinebench::slam
