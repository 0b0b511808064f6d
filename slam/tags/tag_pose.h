// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>

#include "core/geometry/camera.h"
#include "core/geometry/pose.h"

namespace vinebench::slam {

/// Where a tag stands by its corners.
struct TagPose {
  Pose T_cam_tag;
  bool ambiguous = false;  ///< quite another pose is not a thousand times less likely
  bool square = true;      ///< the corners are a square's, within their noise
};

/// T_cam_tag of a square tag of side `size` m from its corners (px; the tag's own lower left, then
/// counter-clockwise as printed). Tag frame: x right, y down on the printed face, z into the tag.
///
/// A small or distant square has two poses that diagnose it nearly as well (Collins and Bartoli,
/// "Infinitesimal plane-based pose estimation", 2014): both are refined by the reprojection error
/// of the corners and the better one is returned. `corner_sigma` is the standard deviation of a
/// corner, px.
TagPose estimate_tag_pose(const std::array<Eigen::Vector2d, 4>& corners, const PinholeCamera& model,
                          double size, double corner_sigma = 0.1);

}  // namespace vinebench::slam
