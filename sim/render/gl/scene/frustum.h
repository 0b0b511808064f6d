// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <vector>

#include "core/geometry/camera.h"

namespace vinebench::sim {

inline constexpr double kNearPlane = 0.03;  ///< m along the optical axis
inline constexpr double kFarPlane = 200.0;  ///< m

/// Takes a point of the camera's frame to OpenGL's clip space, such that it lands on the pixel
/// where `camera` projects it. The first row of the image is at the bottom of OpenGL's window, so
/// that pixels read back come top row first; this mirrors the window, and front faces turn
/// clockwise.
Eigen::Matrix4d clip_from_cam(const PinholeCamera& camera);

/// What a camera can see: the planes of its field of view, in the camera's frame.
class Frustum {
 public:
  explicit Frustum(const PinholeCamera& camera);

  /// Whether some of the box, placed by `cam_from_model`, may be in view. Never wrongly false.
  bool may_see(const Eigen::AlignedBox3f& box, const Eigen::Matrix4d& cam_from_model) const;
  /// The same of a ball in the camera's frame; m.
  bool may_see(const Eigen::Vector3d& centre, double radius) const;
  /// The same of the convex hull of points in the camera's frame; m.
  bool may_see(const std::vector<Eigen::Vector3d>& corners) const;

 private:
  std::array<Eigen::Vector4d, 6> planes_;  // inside where the dot product is positive
};

}  // namespace vinebench::sim
