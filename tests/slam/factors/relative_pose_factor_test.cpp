// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/factors/relative_pose_factor.h"

#include <gtest/gtest.h>

#include "tests/support/factor_check.h"

namespace vinebench::slam {
namespace {

using namespace test;

TEST(RelativePoseFactorTest, JacobiansAreTheNumericOnes) {
  const Pose T_from_to{exp_so3({0.02, -0.03, 0.4}), {0.5, 0.1, 0.02}};
  Matrix6d covariance = 1e-4 * Matrix6d::Identity();
  covariance(0, 1) = covariance(1, 0) = 3e-5;
  const Pose to = body() * T_from_to * Pose{Eigen::Quaterniond::Identity(), {0.03, -0.01, 0.02}};
  // The rotation agrees, for which the Jacobians are exact.
  expect_jacobian(RelativePoseFactor(T_from_to, covariance),
                  {as_vector(to_block(body())), as_vector(to_block(to))});
  // Off by one standard deviation along z: chi squared is 1.
  const Pose off = body() * T_from_to * Pose{Eigen::Quaterniond::Identity(), {0, 0, 0.01}};
  const PoseBlock a = to_block(body());
  const PoseBlock b = to_block(off);
  const double* parameters[] = {a.data(), b.data()};
  Vector6d r;
  ASSERT_TRUE(RelativePoseFactor(T_from_to, covariance).Evaluate(parameters, r.data(), nullptr));
  EXPECT_NEAR(r.squaredNorm(), 1, 1e-9);
}

}  // namespace
}  // namespace vinebench::slam
