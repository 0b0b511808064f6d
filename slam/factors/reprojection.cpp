// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/factors/reprojection.h"

#include <algorithm>
#include <limits>

#include "slam/factors/projection_jacobian.h"

namespace vinebench::slam {
Eigen::Vector3d Reprojection::residual_at(const Eigen::Vector3d& p_cam,
                                          double disparity_offset) const {
  const Eigen::Vector2d pixel = camera_->lens.project(p_cam);
  const double right_x =
      pixel.x() - camera_->lens.fx * camera_->baseline / p_cam.z() + disparity_offset;
  return {
      (pixel.x() - measurement_.pixel.x()) / measurement_.sigma,
      (pixel.y() - measurement_.pixel.y()) / measurement_.sigma,
      measurement_.right_x ? (right_x - *measurement_.right_x) / measurement_.right_sigma : 0.0};
}

Eigen::Vector3d Reprojection::in_camera(const Eigen::Vector3d& p_body) const {
  const Eigen::Matrix3d R_cam_body = camera_->T_cam_body.rotation.toRotationMatrix();
  Eigen::Vector3d p_cam = R_cam_body * p_body + camera_->T_cam_body.translation;
  // A point that a step threw behind the camera keeps a large, finite error that pulls it back.
  p_cam.z() = std::max(p_cam.z(), kMinDepth);
  return p_cam;
}

Reprojection::Linearised Reprojection::linearise(const Pose& T_map_body,
                                                 const Eigen::Vector3d& p_map,
                                                 double disparity_offset) const {
  const Eigen::Vector3d p_body = in_body(T_map_body, p_map);
  const Eigen::Vector3d p_cam = in_camera(p_body);
  const Eigen::Matrix3d R_cam_body = camera_->T_cam_body.rotation.toRotationMatrix();
  const Eigen::Vector3d weights(1 / measurement_.sigma, 1 / measurement_.sigma,
                                measurement_.right_x ? 1 / measurement_.right_sigma : 0);
  Linearised result;
  result.residual = residual_at(p_cam, disparity_offset);
  result.by_point_in_body =
      weights.asDiagonal() * projection_jacobian(*camera_, p_cam) * R_cam_body;
  result.by_pose = result.by_point_in_body * body_point_jacobian(p_body);
  return result;
}

double Reprojection::chi_squared(const Pose& T_map_body, const Eigen::Vector3d& p_map) const {
  const Eigen::Vector3d p_cam = camera_->T_cam_body * (T_map_body.inverse() * p_map);
  if (p_cam.z() < kMinDepth) return std::numeric_limits<double>::infinity();
  return residual_at(p_cam, camera_->disparity_offset).squaredNorm();
}

}  // namespace vinebench::slam
