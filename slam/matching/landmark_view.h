// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>

#include "core/geometry/camera.h"
#include "slam/map/map.h"

namespace vinebench::slam {

/// Where a camera should see a landmark.
struct LandmarkView {
  Eigen::Vector2d pixel;
  double depth;  ///< m
};

/// None where the landmark lies behind the camera or outside of its image, or is seen from so far
/// around that it looks different: a leaf, by more than 60 degrees.
std::optional<LandmarkView> view_landmark(const Landmark& landmark, const Pose& T_cam_map,
                                          const PinholeCamera& lens);

}  // namespace vinebench::slam
