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

TEST(ReprojectionFactorTest, AnUnknownDisparityOffsetMovesTheRightCamerasColumnAlone) {
  StereoCameraModel e = camera();
  PixelMeasurement m;
  m.pixel = {400, 200};
  m.right_x = 380;
  m.right_sigma = 1.2;
  const Eigen::Vector3d p = point();
  expect_jacobian(ReprojectionFactor(e, m, true),
                  {as_vector(to_block(body())), {p.x(), p.y(), p.z()}, {0.3}});
  // The camera's own offset does the same: 0.6 px more in the right camera are half a standard
  // deviation.
  const double before = Reprojection(e, m).linearise(body(), p).residual.z();
  e.disparity_offset = 0.6;
  EXPECT_NEAR(Reprojection(e, m).linearise(body(), p).residual.z() - before, 0.5, 1e-9);
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
