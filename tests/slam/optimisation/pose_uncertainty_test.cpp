// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/optimisation/pose_uncertainty.h"

#include <gtest/gtest.h>

#include "slam/factors/reprojection.h"

namespace vinebench::slam {
namespace {

Pose sample_step() {
  return {exp_so3({0.1, -0.2, 0.5}), {0.4, -0.1, 0.2}};
}

TEST(PoseUncertaintyTest, IsCarriedAlongAMotionAsStepsAre) {
  const Pose T_map_a{exp_so3({0.3, 0.1, -0.4}), {1, 2, 3}};
  const Pose T_a_b = sample_step();
  // A unit step of a alone has rank-one covariance; b's is that of the step it makes there.
  for (int i = 0; i < 6; ++i) {
    constexpr double kSmall = 1e-6;
    Vector6d step = Vector6d::Zero();
    step[i] = kSmall;
    const Pose moved = (T_map_a * T_a_b).inverse() * (T_map_a * step_of(step) * T_a_b);
    Vector6d there;
    there << moved.translation, log_so3(moved.rotation);
    there /= kSmall;
    Matrix6d of_a = Matrix6d::Zero();
    of_a(i, i) = 1;
    EXPECT_LT((carry_covariance(of_a, T_a_b) - there * there.transpose()).norm(), 1e-5) << i;
  }
}

TEST(PoseUncertaintyTest, GrowsFromKeyframeToKeyframe) {
  PoseUncertainty uncertainty;
  uncertainty.start(Matrix6d::Zero());
  const Matrix6d information = 1e6 * Matrix6d::Identity();
  const Matrix6d one = PoseUncertainty::kInflation * 1e-6 * Matrix6d::Identity();
  EXPECT_LT((uncertainty.at({}, information) - one).norm(), 1e-18);
  uncertainty.keyframe(sample_step(), information);
  uncertainty.keyframe({}, information);
  EXPECT_LT((uncertainty.at({}, Matrix6d::Zero()) - 2 * one).norm(), 1e-18);
  // A heading's error of variance v gives a point 2 m ahead the lateral variance 4 v.
  const Matrix6d ahead =
      uncertainty.at({Eigen::Quaterniond::Identity(), {2, 0, 0}}, Matrix6d::Zero());
  EXPECT_NEAR(ahead(1, 1), (1 + 4) * 2 * one(0, 0), 1e-18);
  uncertainty.start(one);
  EXPECT_LT((uncertainty.at({}, Matrix6d::Zero()) - one).norm(), 1e-18);
}

}  // namespace
}  // namespace vinebench::slam
