// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/optimisation/odometry_factors.h"

#include <gtest/gtest.h>

#include <memory>

#include "tests/support/write_poses.h"

namespace vinebench::slam {
namespace {

/// Three keyframes 1 m apart; the later two are said to be 1.2 m after the first and 1.1 m after
/// the second.
class OdometryFactorsTest : public testing::Test {
 protected:
  OdometryFactorsTest() {
    for (int k = 0; k < 3; ++k) {
      map_.add_keyframe(std::make_shared<FrameFeatures>(), ahead(1.0 * k), {});
    }
    map_.keyframe(1).link = OdometryLink{0, ahead(1.2), 1e-4 * Matrix6d::Identity()};
    map_.keyframe(2).link = OdometryLink{1, ahead(1.1), 1e-4 * Matrix6d::Identity()};
  }
  static Pose ahead(double x) { return {Eigen::Quaterniond::Identity(), {x, 0, 0}}; }

  /// Cost reached, keyframes written back.
  double adjusted(const AdjustmentWindow& window) {
    ProblemBuilder problem(map_, window);
    OdometryFactors factors;
    factors.add_to(problem, map_);
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_QR;
    options.function_tolerance = 1e-14;
    options.logging_type = ceres::SILENT;
    const double cost = problem.solve(options);
    test::write_poses(problem, map_);
    return cost;
  }
  double x(int keyframe) const { return map_.keyframe(keyframe).T_map_body.translation.x(); }
  Map map_{1.2};
};

TEST_F(OdometryFactorsTest, MovedKeyframesComeToWhereTheirLinksPutThem) {
  EXPECT_NEAR(adjusted({{1, 2}, {0}}), 0, 1e-9);
  EXPECT_NEAR(x(1), 1.2, 1e-6);
  EXPECT_NEAR(x(2), 2.3, 1e-6);
}

TEST_F(OdometryFactorsTest, ALinkFromAKeyframeThatTakesNoPartIsLeftOut) {
  // One residual is left, of keyframe 2 to 1: both may move, and 2 - 1 is 1.1 m.
  EXPECT_NEAR(adjusted({{1, 2}, {}}), 0, 1e-9);
  EXPECT_NEAR(x(2) - x(1), 1.1, 1e-6);
  EXPECT_EQ(map_.keyframe(0).T_map_body.translation.x(), 0);
}

TEST_F(OdometryFactorsTest, LinksOfFixedKeyframesAreLeftOut) {
  adjusted({{0}, {1}});
  EXPECT_EQ(x(0), 0);
}

TEST_F(OdometryFactorsTest, TheCovarianceWeighsThem) {
  // Keyframe 1 between fixed ones at 0 and 2: 1.2 from the first (sigma 1 cm), 1.1 to the last
  // (sigma 3 cm), so that it should stand at 1.2 and at 0.9. Weights of 9 to 1 give 1.17.
  map_.keyframe(2).link->covariance *= 9;
  map_.keyframe(1).link->T_from_to = ahead(1.2);
  ProblemBuilder problem(map_, {{1, 2}, {0}});
  problem.hold(problem.pose_of(2));
  OdometryFactors factors;
  factors.add_to(problem, map_);
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.function_tolerance = 1e-14;
  options.logging_type = ceres::SILENT;
  // Half of (0.03 / 0.01)^2 + (0.27 / 0.03)^2.
  EXPECT_NEAR(problem.solve(options), 45, 1e-6);
  test::write_poses(problem, map_);
  EXPECT_NEAR(x(1), 1.17, 1e-6);
}

}  // namespace
}  // namespace vinebench::slam
