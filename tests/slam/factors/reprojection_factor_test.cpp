// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/factors/reprojection_factor.h"

#include <gtest/gtest.h>

#include "tests/support/factor_check.h"

namespace vinebench::slam {
namespace {

using namespace test;

TEST(ReprojectionFactorTest, IsZeroAtTheTruth) {
  const StereoCameraModel e = camera();
  PixelMeasurement m;
  const Eigen::Vector3d p_cam = e.T_cam_body * (body().inverse() * point());
  m.pixel = e.lens.project(p_cam);
  m.right_x = m.pixel.x() - e.lens.fx * e.baseline / p_cam.z();
  const ReprojectionFactor error(e, m);
  EXPECT_NEAR(error.chi_squared(body(), point()), 0.0, 1e-20);
  // One pixel off in the right camera alone, at sigma = 1: chi squared is 1.
  m.right_x = *m.right_x + 1;
  EXPECT_NEAR(ReprojectionFactor(e, m).chi_squared(body(), point()), 1.0, 1e-9);
}

TEST(ReprojectionFactorTest, JacobiansAreTheNumericOnes) {
  const StereoCameraModel e = camera();
  PixelMeasurement m;
  m.pixel = {400, 200};
  m.sigma = 1.44;
  const Eigen::Vector3d p = point();
  expect_jacobian(ReprojectionFactor(e, m), {as_vector(to_block(body())), {p.x(), p.y(), p.z()}});
  m.right_x = 380;
  expect_jacobian(ReprojectionFactor(e, m), {as_vector(to_block(body())), {p.x(), p.y(), p.z()}});
}

/// A calibration that is off in every number.
std::vector<double> lens_off() {
  return {0.3, 0.002, 0.003, -0.004, 0.01, 0.03, 0.6, -0.4, 0.004, -0.006, 0.005, 0.007};
}

PixelMeasurement moving_measurement() {
  PixelMeasurement m;
  m.pixel = {400, 200};
  m.right_sigma = 1.2;
  m.velocity << 0.4, -0.1, 0.05, 0.1, -0.2, 0.5;
  return m;
}

TEST(ReprojectionFactorTest, JacobiansByAnUnknownCalibrationAreTheNumericOnes) {
  const StereoCameraModel e = camera();
  PixelMeasurement m = moving_measurement();
  const Eigen::Vector3d p = point();
  const auto T_body_cam = as_vector(to_block(e.T_cam_body.inverse()));
  for (const std::optional<double> right_x : {std::optional<double>{}, std::optional(380.0)}) {
    m.right_x = right_x;
    expect_jacobian(ReprojectionFactor(e, m, {.calibration = true, .velocity = false}),
                    {as_vector(to_block(body())), {p.x(), p.y(), p.z()}, T_body_cam, lens_off()});
  }
}

TEST(ReprojectionFactorTest, JacobiansByAnUnknownVelocityAreTheNumericOnes) {
  const StereoCameraModel e = camera();
  PixelMeasurement m = moving_measurement();
  m.right_x = 380;
  const Eigen::Vector3d p = point();
  const std::vector<double> velocity(m.velocity.data(), m.velocity.data() + 6);
  std::vector<std::vector<double>> blocks{as_vector(to_block(body())), {p.x(), p.y(), p.z()}};
  for (const double late : {0.0, 0.03}) {
    m.late = late;
    auto of_velocity = blocks;
    of_velocity.push_back(velocity);
    expect_jacobian(ReprojectionFactor(e, m, {.calibration = false, .velocity = true}),
                    of_velocity);
    auto of_all = blocks;
    of_all.push_back(as_vector(to_block(e.T_cam_body.inverse())));
    of_all.push_back(lens_off());
    of_all.push_back(velocity);
    expect_jacobian(ReprojectionFactor(e, m, {.calibration = true, .velocity = true}), of_all);
  }
}

// 10 ms late at 0.5 m/s the body is 5 mm on: the same as a point 5 mm back.
TEST(ReprojectionFactorTest, ALateCameraSeesFromWhereTheBodyIsByThen) {
  StereoCameraModel late = camera();
  late.time_offset = 0.01;
  PixelMeasurement m = moving_measurement();
  m.velocity << 0.5, 0, 0, 0, 0, 0;
  const Eigen::Vector3d ahead = body().rotation * Eigen::Vector3d(0.005, 0, 0);
  const Eigen::Vector3d in_time = Reprojection(camera(), m).residual(body(), point() - ahead);
  EXPECT_LT((Reprojection(late, m).residual(body(), point()) - in_time).norm(), 1e-9);
  EXPECT_NEAR(Reprojection(late, m).chi_squared(body(), point()), in_time.squaredNorm(), 1e-6);
  // A rolling shutter of 20 ms exposes the last row, 479.5 of 480, 10 ms late too.
  StereoCameraModel rolling = camera();
  rolling.readout = 0.02;
  m.pixel.y() = 480;
  EXPECT_LT((Reprojection(rolling, m).residual(body(), point()) -
             Reprojection(late, m).residual(body(), point()))
                .norm(),
            1e-9);
}

TEST(ReprojectionFactorTest, ADisparityOffsetMovesTheRightCamerasColumnAlone) {
  StereoCameraModel e = camera();
  PixelMeasurement m;
  m.pixel = {400, 200};
  m.right_x = 380;
  m.right_sigma = 1.2;
  const Eigen::Vector3d p = point();
  // 0.6 px more in the right camera are half a standard deviation.
  const double before = Reprojection(e, m).linearise(body(), p).residual.z();
  e.disparity_offset = 0.6;
  EXPECT_NEAR(Reprojection(e, m).linearise(body(), p).residual.z() - before, 0.5, 1e-9);
  EXPECT_EQ(Reprojection(e, m).residual(body(), p).head<2>(),
            Reprojection(camera(), m).residual(body(), p).head<2>());
}

TEST(ReprojectionFactorTest, BehindTheCameraIsNoInlierAndStaysFinite) {
  const StereoCameraModel e = camera();
  PixelMeasurement m;
  m.pixel = {400, 200};
  const Eigen::Vector3d behind = body() * (e.T_cam_body.inverse() * Eigen::Vector3d(0, 0, -1));
  const ReprojectionFactor error(e, m);
  EXPECT_GT(error.chi_squared(body(), behind), 1e12);
  const PoseBlock block = to_block(body());
  const double* parameters[] = {block.data(), behind.data()};
  double residuals[2];
  ASSERT_TRUE(error.Evaluate(parameters, residuals, nullptr));
  EXPECT_TRUE(std::isfinite(residuals[0]) && std::isfinite(residuals[1]));
}

}  // namespace
}  // namespace vinebench::slam
