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

}  // namespace
}  // namespace vinebench::slam
