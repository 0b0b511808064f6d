// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/factors/pose_manifold.h"

#include <gtest/gtest.h>

#include "tests/support/factor_check.h"

namespace vinebench::slam {
namespace {

using namespace test;

TEST(PoseManifoldTest, MinusUndoesPlus) {
  const PoseBlock start = to_block(body());
  Vector6d step;
  step << 0.1, -0.2, 0.3, 0.02, 0.4, -0.1;
  PoseBlock stepped;
  const PoseManifold manifold;
  ASSERT_TRUE(manifold.Plus(start.data(), step.data(), stepped.data()));
  // The step is in the body's own frame.
  const Pose expected = body() * step_of(step);
  EXPECT_LT((from_block(stepped.data()).translation - expected.translation).norm(), 1e-15);
  // Minus gives the translation in the body's frame and the rotation vector: those of the step.
  const Pose by_step = step_of(step);
  Vector6d back;
  ASSERT_TRUE(manifold.Minus(stepped.data(), start.data(), back.data()));
  EXPECT_LT((back.head<3>() - by_step.translation).norm(), 1e-12);
  EXPECT_LT((back.tail<3>() - log_so3(by_step.rotation)).norm(), 1e-12);
}

}  // namespace
}  // namespace vinebench::slam
