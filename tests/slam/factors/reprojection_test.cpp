// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/factors/reprojection.h"

#include <gtest/gtest.h>

#include "tests/support/factor_check.h"

namespace vinebench::slam {
namespace {

using namespace test;

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

// To the bit: a step that is tried is judged by the one, and what it is judged against by the
// other.
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

// An image of a stamp of its own is as one of a camera that is known to be late by so much; where
// both are, the times add.
TEST(ReprojectionTest, AnImagesOwnStampIsAsTheCamerasOffset) {
  StereoCameraModel late = camera();
  late.time_offset = 0.03;
  late.readout = 0.01;
  StereoCameraModel less_late = late;
  less_late.time_offset = 0.01;
  PixelMeasurement m;
  m.pixel = {400, 200};
  m.right_x = 380;
  m.velocity << 1, 0.2, -0.1, 0.1, -0.3, 0.5;
  PixelMeasurement stamped = m;
  stamped.late = 0.02;
  const Reprojection by_camera(late, m), by_both(less_late, stamped);
  EXPECT_LT((by_camera.residual(body(), point()) - by_both.residual(body(), point())).norm(), 1e-9);
  const auto a = by_camera.linearise(body(), point()), b = by_both.linearise(body(), point());
  EXPECT_LT((a.by_pose - b.by_pose).norm(), 1e-9 * a.by_pose.norm());
  EXPECT_LT((by_camera.by_calibration(body(), point(), camera()) -
             by_both.by_calibration(body(), point(), camera()))
                .norm(),
            1e-9 * by_camera.by_calibration(body(), point(), camera()).norm());
  const StereoCameraModel known = camera();
  EXPECT_GT((Reprojection(known, stamped).residual(body(), point()) -
             Reprojection(known, m).residual(body(), point()))
                .norm(),
            1);  // 2 cm at 1 m/s are pixels
}

}  // namespace
}  // namespace vinebench::slam
