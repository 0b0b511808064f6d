// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/render/gl/scene/frustum.h"

#include <algorithm>

namespace vinebench::sim {

Eigen::Matrix4d clip_from_cam(const PinholeCamera& camera) {
  const double w = camera.width;
  const double h = camera.height;
  const double depth = kFarPlane - kNearPlane;
  Eigen::Matrix4d m = Eigen::Matrix4d::Zero();
  // OpenGL's pixel u has its centre at u + 0.5 of the window's w.
  m.row(0) << 2 * camera.fx / w, 0, (2 * camera.cx + 1) / w - 1, 0;
  m.row(1) << 0, 2 * camera.fy / h, (2 * camera.cy + 1) / h - 1, 0;
  m.row(2) << 0, 0, (kFarPlane + kNearPlane) / depth, -2 * kFarPlane * kNearPlane / depth;
  m(3, 2) = 1;
  return m;
}

Frustum::Frustum(const PinholeCamera& camera) {
  // A point is inside where -w <= x, y, z <= w of its clip coordinates.
  const Eigen::Matrix4d m = clip_from_cam(camera);
  for (int axis = 0; axis < 3; ++axis) {
    planes_[2 * axis] = m.row(3) + m.row(axis);
    planes_[2 * axis + 1] = m.row(3) - m.row(axis);
  }
}

bool Frustum::may_see(const Eigen::AlignedBox3f& box, const Eigen::Matrix4d& cam_from_model) const {
  const Eigen::Vector3d centre = box.center().cast<double>();
  const Eigen::Vector3d half = 0.5 * box.sizes().cast<double>();
  for (const Eigen::Vector4d& plane_cam : planes_) {
    const Eigen::Vector4d plane = cam_from_model.transpose() * plane_cam;
    const double reach = plane.head<3>().cwiseAbs().dot(half);
    if (plane.head<3>().dot(centre) + plane.w() + reach < 0) return false;
  }
  return true;
}

bool Frustum::may_see(const std::vector<Eigen::Vector3d>& corners) const {
  return std::ranges::all_of(planes_, [&](const Eigen::Vector4d& plane) {
    return std::ranges::any_of(corners, [&](const Eigen::Vector3d& corner) {
      return plane.head<3>().dot(corner) + plane.w() >= 0;
    });
  });
}

bool Frustum::may_see(const Eigen::Vector3d& centre, double radius) const {
  for (const Eigen::Vector4d& plane : planes_) {
    const double distance = plane.head<3>().dot(centre) + plane.w();
    if (distance < -radius * plane.head<3>().norm()) return false;
  }
  return true;
}

}  // namespace vinebench::sim
