// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/factors/reprojection.h"

#include <gtest/gtest.h>

#include "slam/optimisation/bundle_adjustment.h"

namespace vinebench::slam {
namespace {

StereoCameraModel camera() {
  const PinholeCamera lens{752, 480, 263.2786, 263.2786, 375.5, 239.5, {}};
  return {lens, Pose{exp_so3({0.4, -1.1, 0.8}), {0.1, 0.05, -0.4}}, 0.12};
}

Pose body() {
  return {exp_so3({0.1, 0.2, -0.3}), {0.5, -0.2, 0.1}};
}

/// A point 1.5 m in front of the camera, off its axis.
Eigen::Vector3d point() {
  return body() * (camera().T_cam_body.inverse() * Eigen::Vector3d(0.4, -0.3, 1.5));
}

/// Central differences by the manifold's own steps against the analytic Jacobian, every column.
void expect_jacobian(const ceres::CostFunction& cost, std::vector<std::vector<double>> blocks) {
  const int rows = cost.num_residuals();
  std::vector<std::vector<double>> jacobians;
  std::vector<double*> parameters;
  std::vector<double*> jacobian_pointers;
  for (std::vector<double>& block : blocks) {
    jacobians.emplace_back(block.size() * static_cast<std::size_t>(rows));
    parameters.push_back(block.data());
  }
  for (auto& jacobian : jacobians) jacobian_pointers.push_back(jacobian.data());
  std::vector<double> residuals(static_cast<std::size_t>(rows));
  ASSERT_TRUE(cost.Evaluate(parameters.data(), residuals.data(), jacobian_pointers.data()));

  const double h = 1e-6;  // error of a central difference: about h^2 times the third derivative
  const PoseManifold manifold;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const std::size_t tangent = blocks[b].size() == 7 ? 6 : blocks[b].size();
    for (std::size_t c = 0; c < tangent; ++c) {
      std::vector<std::vector<double>> values;
      for (const double sign : {1.0, -1.0}) {
        std::vector<double> step(tangent, 0.0);
        step[c] = sign * h;
        std::vector<double> moved = blocks[b];
        if (tangent == 6) {
          manifold.Plus(blocks[b].data(), step.data(), moved.data());
        } else {
          moved[c] += step[c];
        }
        std::vector<double*> at = parameters;
        at[b] = moved.data();
        values.emplace_back(static_cast<std::size_t>(rows));
        ASSERT_TRUE(cost.Evaluate(at.data(), values.back().data(), nullptr));
      }
      for (std::size_t r = 0; r < static_cast<std::size_t>(rows); ++r) {
        const double numeric = (values[0][r] - values[1][r]) / (2 * h);
        const double analytic = jacobians[b][r * blocks[b].size() + c];
        // Derivatives are of the order of 100 px/m; rounding leaves about 1e-13 * 100 / h = 1e-5.
        EXPECT_NEAR(analytic, numeric, 1e-4) << "block " << b << " row " << r << " column " << c;
      }
    }
  }
}

std::vector<double> as_vector(const PoseBlock& block) {
  return {block.begin(), block.end()};
}

TEST(ReprojectionErrorTest, IsZeroAtTheTruth) {
  const StereoCameraModel e = camera();
  PixelMeasurement m;
  const Eigen::Vector3d p_cam = e.T_cam_body * (body().inverse() * point());
  m.pixel = e.lens.project(p_cam);
  m.right_x = m.pixel.x() - e.lens.fx * e.baseline / p_cam.z();
  const ReprojectionError error(e, m);
  EXPECT_NEAR(error.chi_squared(body(), point()), 0.0, 1e-20);
  // One pixel off in the right camera alone, at sigma = 1: chi squared is 1.
  m.right_x = *m.right_x + 1;
  EXPECT_NEAR(ReprojectionError(e, m).chi_squared(body(), point()), 1.0, 1e-9);
}

TEST(ReprojectionErrorTest, JacobiansAreTheNumericOnes) {
  const StereoCameraModel e = camera();
  PixelMeasurement m;
  m.pixel = {400, 200};
  m.sigma = 1.44;
  const Eigen::Vector3d p = point();
  expect_jacobian(ReprojectionError(e, m), {as_vector(to_block(body())), {p.x(), p.y(), p.z()}});
  m.right_x = 380;
  expect_jacobian(ReprojectionError(e, m), {as_vector(to_block(body())), {p.x(), p.y(), p.z()}});
}

TEST(ReprojectionErrorTest, AnUnknownDisparityOffsetMovesTheRightCamerasColumnAlone) {
  StereoCameraModel e = camera();
  PixelMeasurement m;
  m.pixel = {400, 200};
  m.right_x = 380;
  m.right_sigma = 1.2;
  const Eigen::Vector3d p = point();
  expect_jacobian(ReprojectionError(e, m, true),
                  {as_vector(to_block(body())), {p.x(), p.y(), p.z()}, {0.3}});
  // The camera's own offset does the same: 0.6 px more in the right camera are half a standard
  // deviation.
  const double before = Reprojection(e, m).linearise(body(), p).residual.z();
  e.disparity_offset = 0.6;
  EXPECT_NEAR(Reprojection(e, m).linearise(body(), p).residual.z() - before, 0.5, 1e-9);
}

TEST(StereoCameraModelTest, DepthAndDisparityAreEachOthersInverse) {
  StereoCameraModel e = camera();
  e.disparity_offset = -0.4;
  // At 2 m by lens and baseline, and 0.4 px more for the offset.
  EXPECT_NEAR(e.disparity_of(2), e.lens.fx * e.baseline / 2 + 0.4, 1e-12);
  EXPECT_NEAR(e.depth_of(e.disparity_of(2)), 2, 1e-12);
}

TEST(ReprojectionTest, StepsThePoseAsTheManifoldDoes) {
  const StereoCameraModel e = camera();
  PixelMeasurement m;
  m.pixel = {400, 200};
  m.right_x = 380;
  const Reprojection reprojection(e, m);
  const Reprojection::Linearised at = reprojection.linearise(body(), point());
  constexpr double kStep = 1e-6;  // m and rad; central differences are good to about its square
  for (int i = 0; i < 6; ++i) {
    Vector6d step = Vector6d::Zero();
    step[i] = kStep;
    const Eigen::Vector3d ahead = reprojection.linearise(body() * step_of(step), point()).residual;
    const Eigen::Vector3d back = reprojection.linearise(body() * step_of(-step), point()).residual;
    const Eigen::Vector3d numeric = (ahead - back) / (2 * kStep);
    EXPECT_LT((at.by_pose.col(i) - numeric).norm(), 1e-4 * (1 + numeric.norm())) << i;
  }
}

// Bitwise equal: a trial step is evaluated by one and compared with a value of the other.
TEST(ReprojectionTest, TheResidualAloneIsThatOfTheLinearisation) {
  const StereoCameraModel e = camera();
  const Eigen::Vector3d behind = body() * (e.T_cam_body.inverse() * Eigen::Vector3d(0, 0, -1));
  PixelMeasurement m;
  m.pixel = {400, 200};
  for (const Eigen::Vector3d& p : {point(), behind}) {
    for (const std::optional<double> right_x : {std::optional<double>(), {380}}) {
      m.right_x = right_x;
      const Reprojection reprojection(e, m);
      EXPECT_EQ(reprojection.residual(body(), p), reprojection.linearise(body(), p).residual);
    }
  }
}

TEST(ReprojectionErrorTest, BehindTheCameraIsNoInlierAndStaysFinite) {
  const StereoCameraModel e = camera();
  PixelMeasurement m;
  m.pixel = {400, 200};
  const Eigen::Vector3d behind = body() * (e.T_cam_body.inverse() * Eigen::Vector3d(0, 0, -1));
  const ReprojectionError error(e, m);
  EXPECT_GT(error.chi_squared(body(), behind), 1e12);
  const PoseBlock block = to_block(body());
  const double* parameters[] = {block.data(), behind.data()};
  double residuals[2];
  ASSERT_TRUE(error.Evaluate(parameters, residuals, nullptr));
  EXPECT_TRUE(std::isfinite(residuals[0]) && std::isfinite(residuals[1]));
}

TEST(OdometryErrorTest, JacobiansAreTheNumericOnes) {
  const Pose T_from_to{exp_so3({0.02, -0.03, 0.4}), {0.5, 0.1, 0.02}};
  Matrix6d covariance = 1e-4 * Matrix6d::Identity();
  covariance(0, 1) = covariance(1, 0) = 3e-5;
  const Pose to = body() * T_from_to * Pose{Eigen::Quaterniond::Identity(), {0.03, -0.01, 0.02}};
  // The rotation agrees, for which the Jacobians are exact.
  expect_jacobian(OdometryError(T_from_to, covariance),
                  {as_vector(to_block(body())), as_vector(to_block(to))});
  // Off by one standard deviation along z: chi squared is 1.
  const Pose off = body() * T_from_to * Pose{Eigen::Quaterniond::Identity(), {0, 0, 0.01}};
  const PoseBlock a = to_block(body());
  const PoseBlock b = to_block(off);
  const double* parameters[] = {a.data(), b.data()};
  Vector6d r;
  ASSERT_TRUE(OdometryError(T_from_to, covariance).Evaluate(parameters, r.data(), nullptr));
  EXPECT_NEAR(r.squaredNorm(), 1, 1e-9);
}

TEST(TagCornerErrorTest, JacobiansAreTheNumericOnes) {
  const StereoCameraModel e = camera();
  const Pose T_map_tag{exp_so3({0.3, -0.2, 0.5}), point()};
  expect_jacobian(TagCornerError(e, {300, 250}, 0.3, tag_corners(0.161)[1]),
                  {as_vector(to_block(body())), as_vector(to_block(T_map_tag))});
}

}  // namespace
}  // namespace vinebench::slam
