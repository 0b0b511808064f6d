// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/geometry/step_covariance.h"

#include <gtest/gtest.h>

namespace vinebench {
namespace {

TEST(StepCovarianceTest, IsCarriedAlongAMotionAsStepsAre) {
  const Pose T_map_a{exp_so3({0.3, 0.1, -0.4}), {1, 2, 3}};
  const Pose T_a_b{exp_so3({0.1, -0.2, 0.5}), {0.4, -0.1, 0.2}};
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

}  // namespace
}  // namespace vinebench
