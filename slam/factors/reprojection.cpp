// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/factors/reprojection.h"

#include <algorithm>
#include <limits>

#include "slam/factors/projection_jacobian.h"

namespace vinebench::slam {

Eigen::Vector3d Reprojection::residual_at(const Eigen::Vector3d& p_cam) const {
  const Eigen::Vector2d pixel = camera_->lens.project(p_cam);
  const double right_x = pixel.x() - camera_->disparity_of(pixel, p_cam.z());
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

Eigen::Vector3d Reprojection::weights() const {
  return {1 / measurement_.sigma, 1 / measurement_.sigma,
          measurement_.right_x ? 1 / measurement_.right_sigma : 0};
}

Reprojection::Linearised Reprojection::linearise(const Pose& T_map_body,
                                                 const Eigen::Vector3d& p_map) const {
  const Eigen::Vector3d p_seen = in_body(T_map_body, p_map);
  const Eigen::Vector3d p_cam = in_camera(p_seen);
  const Eigen::Matrix3d R_cam_body = camera_->T_cam_body.rotation.toRotationMatrix();
  Linearised result;
  result.residual = residual_at(p_cam);
  result.by_point_in_body =
      weights().asDiagonal() * projection_jacobian(*camera_, p_cam) * R_cam_body;
  if (!has_times()) {
    result.by_pose = result.by_point_in_body * body_point_jacobian(p_seen);
    return result;
  }
  const Pose way = way_until_exposed();
  // The velocity's first part is along axes that turn with the body meanwhile. Of the second one's
  // right Jacobian these are the first terms, good to a tenth of a thousandth for 0.1 rad.
  const Eigen::Matrix3d turn = cross_matrix(measurement_.velocity.tail<3>() * late());
  result.by_velocity.rightCols<3>() = late() * result.by_point_in_body * cross_matrix(p_seen) *
                                      (Eigen::Matrix3d::Identity() - turn / 2 + turn * turn / 6);
  result.by_point_in_body *= way.rotation.toRotationMatrix().transpose();
  result.by_velocity.leftCols<3>() = -late() * result.by_point_in_body;
  result.by_pose = result.by_point_in_body * body_point_jacobian(way * p_seen);
  return result;
}

Eigen::Matrix<double, 3, kPairUnknowns> Reprojection::by_calibration(
    const Pose& T_map_body, const Eigen::Vector3d& p_map, const StereoCameraModel& nominal) const {
  const Eigen::Vector3d p_seen = in_body(T_map_body, p_map);
  const Eigen::Vector3d p_cam = in_camera(p_seen);
  const Eigen::Matrix3d by_point = projection_jacobian(*camera_, p_cam);
  const PinholeCamera& lens = camera_->lens;
  const Eigen::Vector2d pixel = lens.project(p_cam);
  const double x = pixel.x() - lens.cx;
  const double y = pixel.y() - lens.cy;
  const double disparity = lens.fx * camera_->baseline / p_cam.z();
  const double right = (x - disparity) / lens.fx;
  const double down = y / lens.fy;
  const double measured = camera_->disparity_of(pixel, p_cam.z());
  const double longer = lens.fx / nominal.lens.fx;
  // The velocity's first part is along axes that turn with the body meanwhile.
  Vector6d velocity = measurement_.velocity;
  velocity.head<3>() = way_until_exposed().rotation.conjugate() * velocity.head<3>();
  const Eigen::Vector3d by_time = by_point * camera_->T_cam_body.rotation.toRotationMatrix() *
                                  body_point_jacobian(p_seen) * velocity;
  Eigen::Matrix<double, 3, kPairUnknowns> J;
  J.leftCols<6>() = by_point * body_point_jacobian(p_cam);
  J.col(PairNumber::kDisparityOffset) << 0, 0, 1;
  J.col(PairNumber::kDisparitySlope) << 0, 0, x - disparity;
  // Rays stay: all columns but the offset are as long as the focal length.
  J.col(PairNumber::kFocal) << x / longer, y / longer,
      (x - measured - camera_->disparity_offset) / longer;
  const double by_right = 1 + error_by_right_ray(*camera_, right, down, disparity);
  J.col(PairNumber::kBaseline) << 0, 0,
      disparity * (camera_->right_ahead * right - by_right) * nominal.baseline / camera_->baseline;
  J.col(PairNumber::kTime) = by_time;
  J.col(PairNumber::kReadout) = by_time * (measurement_.pixel.y() / lens.height - 0.5);
  J.middleCols<2>(PairNumber::kPrincipalPoint) << 1, 0, 0, 1, 1, 0;
  J.middleCols<3>(PairNumber::kRightTurn).topRows<2>().setZero();
  J.block<1, 3>(2, PairNumber::kRightTurn) << lens.fx * right * down, -lens.fx * right * right,
      lens.fx * down;
  J.col(PairNumber::kRightAhead) << 0, 0, disparity * right;
  return weights().asDiagonal() * J;
}

double Reprojection::chi_squared(const Pose& T_map_body, const Eigen::Vector3d& p_map) const {
  const Eigen::Vector3d p_cam =
      has_times()
          ? camera_->T_cam_body * (way_until_exposed().inverse() * (T_map_body.inverse() * p_map))
          : camera_->T_cam_body * (T_map_body.inverse() * p_map);
  if (p_cam.z() < kMinDepth) return std::numeric_limits<double>::infinity();
  return residual_at(p_cam).squaredNorm();
}

}  // namespace vinebench::slam
