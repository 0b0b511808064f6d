// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/factors/reprojection.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <limits>

namespace vinebench::slam {
namespace {

using Matrix3d = Eigen::Matrix3d;
using RowMajor37 = Eigen::Matrix<double, 3, 7, Eigen::RowMajor>;

/// Nearer than this the projection says nothing.
constexpr double kMinDepth = 0.02;  // m

Matrix3d cross_matrix(const Eigen::Vector3d& v) {
  Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

/// Rows: d(u, v, u_right) / d(p_cam), px per m.
Matrix3d projection_jacobian(const StereoCameraModel& camera, const Eigen::Vector3d& p) {
  const double inv_z = 1.0 / p.z();
  const double fx_z = camera.lens.fx * inv_z;
  const double fy_z = camera.lens.fy * inv_z;
  Matrix3d J;
  J << fx_z, 0, -fx_z * p.x() * inv_z,  //
      0, fy_z, -fy_z * p.y() * inv_z,   //
      fx_z, 0, -fx_z * (p.x() - camera.baseline) * inv_z;
  return J;
}

/// Derivative of a point in the body frame by the step of PoseManifold.
Eigen::Matrix<double, 3, 6> body_point_jacobian(const Eigen::Vector3d& p_body) {
  Eigen::Matrix<double, 3, 6> J;
  J << -Matrix3d::Identity(), cross_matrix(p_body);
  return J;
}

template <class Jacobian>
void copy_rows(const Jacobian& source, int rows, double* target) {
  const int columns = static_cast<int>(source.cols());
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) target[r * columns + c] = source(r, c);
  }
}

}  // namespace

PoseBlock to_block(const Pose& pose) {
  const Eigen::Quaterniond& q = pose.rotation;
  const Eigen::Vector3d& p = pose.translation;
  return {q.x(), q.y(), q.z(), q.w(), p.x(), p.y(), p.z()};
}

Pose from_block(const double* b) {
  return {Eigen::Quaterniond(b[3], b[0], b[1], b[2]).normalized(), {b[4], b[5], b[6]}};
}

bool PoseManifold::Plus(const double* x, const double* delta, double* x_plus_delta) const {
  const Pose stepped = from_block(x) * step_of(Eigen::Map<const Vector6d>(delta));
  std::ranges::copy(to_block(stepped), x_plus_delta);
  return true;
}

bool PoseManifold::PlusJacobian(const double*, double* jacobian) const {
  Eigen::Map<Eigen::Matrix<double, 7, 6, Eigen::RowMajor>> J(jacobian);
  J.setZero();
  J.topRows<6>().setIdentity();
  return true;
}

bool PoseManifold::Minus(const double* y, const double* x, double* y_minus_x) const {
  const Pose T_x_y = from_block(x).inverse() * from_block(y);
  Eigen::Map<Vector6d> difference(y_minus_x);
  difference << T_x_y.translation, log_so3(T_x_y.rotation);
  return true;
}

bool PoseManifold::MinusJacobian(const double*, double* jacobian) const {
  Eigen::Map<Eigen::Matrix<double, 6, 7, Eigen::RowMajor>> J(jacobian);
  J.setZero();
  J.leftCols<6>().setIdentity();
  return true;
}

ReprojectionError::ReprojectionError(const StereoCameraModel& camera,
                                     const PixelMeasurement& measurement, bool offset_unknown)
    : reprojection_(camera, measurement) {
  set_num_residuals(measurement.size());
  *mutable_parameter_block_sizes() = {7, 3};
  if (offset_unknown) mutable_parameter_block_sizes()->push_back(1);
}

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
  const Matrix3d R_cam_body = camera_->T_cam_body.rotation.toRotationMatrix();
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
  const Matrix3d R_cam_body = camera_->T_cam_body.rotation.toRotationMatrix();
  const Eigen::Vector3d weights(1 / measurement_.sigma, 1 / measurement_.sigma,
                                measurement_.right_x ? 1 / measurement_.right_sigma : 0);
  Linearised result;
  result.residual = residual_at(p_cam, disparity_offset);
  result.by_point_in_body =
      weights.asDiagonal() * projection_jacobian(*camera_, p_cam) * R_cam_body;
  result.by_pose = result.by_point_in_body * body_point_jacobian(p_body);
  return result;
}

bool ReprojectionError::Evaluate(double const* const* parameters, double* residuals,
                                 double** jacobians) const {
  const Pose T_map_body = from_block(parameters[0]);
  const Eigen::Map<const Eigen::Vector3d> p_map(parameters[1]);
  const bool offset_unknown = parameter_block_sizes().size() > 2;
  const double offset = offset_unknown ? parameters[2][0] : reprojection_.camera().disparity_offset;
  if (jacobians == nullptr) {
    const Eigen::Vector3d residual = reprojection_.residual(T_map_body, p_map, offset);
    std::copy_n(residual.data(), num_residuals(), residuals);
    return true;
  }
  const Reprojection::Linearised at = reprojection_.linearise(T_map_body, p_map, offset);
  std::copy_n(at.residual.data(), num_residuals(), residuals);
  if (jacobians[0] != nullptr) {
    RowMajor37 J = RowMajor37::Zero();
    J.leftCols<6>() = at.by_pose;
    copy_rows(J, num_residuals(), jacobians[0]);
  }
  if (jacobians[1] != nullptr) {
    const Matrix3d R_body_map = T_map_body.rotation.toRotationMatrix().transpose();
    copy_rows(Matrix3d(at.by_point_in_body * R_body_map), num_residuals(), jacobians[1]);
  }
  if (offset_unknown && jacobians[2] != nullptr) {
    std::fill_n(jacobians[2], num_residuals(), 0.0);
    if (num_residuals() == 3) jacobians[2][2] = reprojection_.by_disparity_offset();
  }
  return true;
}

double Reprojection::chi_squared(const Pose& T_map_body, const Eigen::Vector3d& p_map) const {
  const Eigen::Vector3d p_cam = camera_->T_cam_body * (T_map_body.inverse() * p_map);
  if (p_cam.z() < kMinDepth) return std::numeric_limits<double>::infinity();
  return residual_at(p_cam, camera_->disparity_offset).squaredNorm();
}

TagCornerError::TagCornerError(const StereoCameraModel& camera, const Eigen::Vector2d& pixel,
                               double sigma, const Eigen::Vector3d& p_tag)
    : camera_(&camera), pixel_(pixel), sigma_(sigma), p_tag_(p_tag) {
  set_num_residuals(2);
  *mutable_parameter_block_sizes() = {7, 7};
}

bool TagCornerError::Evaluate(double const* const* parameters, double* residuals,
                              double** jacobians) const {
  const Pose T_map_body = from_block(parameters[0]);
  const Pose T_map_tag = from_block(parameters[1]);
  const Eigen::Vector3d p_body = T_map_body.inverse() * (T_map_tag * p_tag_);
  Eigen::Vector3d p_cam = camera_->T_cam_body * p_body;
  p_cam.z() = std::max(p_cam.z(), kMinDepth);
  const Eigen::Vector2d r = (camera_->lens.project(p_cam) - pixel_) / sigma_;
  std::copy_n(r.data(), 2, residuals);
  if (jacobians == nullptr) return true;

  // The corners of distorted images are undistorted before they come here, so that the pinhole's
  // own Jacobian is exact.
  const Matrix3d J_body = projection_jacobian(*camera_, p_cam) *
                          camera_->T_cam_body.rotation.toRotationMatrix() / sigma_;
  if (jacobians[0] != nullptr) {
    RowMajor37 J = RowMajor37::Zero();
    J.leftCols<6>() = J_body * body_point_jacobian(p_body);
    copy_rows(J, 2, jacobians[0]);
  }
  if (jacobians[1] != nullptr) {
    const Matrix3d R_body_tag =
        (T_map_body.rotation.conjugate() * T_map_tag.rotation).toRotationMatrix();
    RowMajor37 J = RowMajor37::Zero();
    J.leftCols<3>() = J_body * R_body_tag;
    J.middleCols<3>(3) = -J_body * R_body_tag * cross_matrix(p_tag_);
    copy_rows(J, 2, jacobians[1]);
  }
  return true;
}

OdometryError::OdometryError(const Pose& T_from_to, const Matrix6d& covariance)
    : T_from_to_(T_from_to), weight_(covariance.inverse().llt().matrixU()) {}

bool OdometryError::Evaluate(double const* const* parameters, double* residuals,
                             double** jacobians) const {
  const Pose T_from_to = from_block(parameters[0]).inverse() * from_block(parameters[1]);
  const Pose error = T_from_to_.inverse() * T_from_to;
  Vector6d r;
  r << error.translation, log_so3(error.rotation);
  Eigen::Map<Vector6d> weighted(residuals);
  weighted = weight_ * r;
  if (jacobians == nullptr) return true;
  using RowMajor67 = Eigen::Matrix<double, 6, 7, Eigen::RowMajor>;
  if (jacobians[0] != nullptr) {
    // The earlier pose's step seen from the later end, the other way about.
    const Matrix3d R_measured = T_from_to_.rotation.toRotationMatrix().transpose();
    Matrix6d J = Matrix6d::Zero();
    J.topLeftCorner<3, 3>() = -R_measured;
    J.topRightCorner<3, 3>() = R_measured * cross_matrix(T_from_to.translation);
    J.bottomRightCorner<3, 3>() = -T_from_to.rotation.toRotationMatrix().transpose();
    Eigen::Map<RowMajor67> block(jacobians[0]);
    block.setZero();
    block.leftCols<6>() = weight_ * J;
  }
  if (jacobians[1] != nullptr) {
    Matrix6d J = Matrix6d::Identity();
    J.topLeftCorner<3, 3>() = error.rotation.toRotationMatrix();
    Eigen::Map<RowMajor67> block(jacobians[1]);
    block.setZero();
    block.leftCols<6>() = weight_ * J;
  }
  return true;
}

}  // namespace vinebench::slam
