// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/placement/pose_chain.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vinebench::harness {
namespace {

/// A straight drive of ten steps of a metre.
std::vector<Pose> straight() {
  std::vector<Pose> poses;
  for (int k = 0; k <= 10; ++k) poses.push_back({{1, 0, 0, 0}, {1.0 * k, 0, 0}});
  return poses;
}

std::vector<Matrix6d> nothing() {
  return std::vector<Matrix6d>(11, Matrix6d::Zero());
}

// Each step adds its offset's variance on three axes. The turn after step k swings the 10 - k
// metres that follow, on two axes: the sum of m^2 for m from 0 to 9 is 285.
TEST(PoseChainTest, ErrorsGrowWithTheWay) {
  const PoseChain chain(straight(), {2e-3, 3e-4});
  const std::vector<double> errors = chain.position_errors(nothing());
  EXPECT_NEAR(errors[0], 0, 1e-5);
  EXPECT_NEAR(errors[1], std::sqrt(3) * 2e-3, 1e-6);
  EXPECT_NEAR(errors[10], std::sqrt(3 * 10 * 4e-6 + 2 * 285 * 9e-8), 1e-6);
  EXPECT_EQ(chain.information(nothing()), 0);
}

// With turns next to exact, and the end measured exactly, the offsets are a Brownian bridge: at
// pose k the variance is k (10 - k) / 10 of a step's.
TEST(PoseChainTest, AMeasurementAtTheEndHoldsTheWayBetween) {
  const PoseChain chain(straight(), {1e-3, 1e-9});
  std::vector<Matrix6d> measured = nothing();
  measured[10] = 1e16 * Matrix6d::Identity();
  const std::vector<double> errors = chain.position_errors(measured);
  for (const int k : {2, 5, 9}) {
    EXPECT_NEAR(errors[static_cast<std::size_t>(k)], 1e-3 * std::sqrt(3 * k * (10 - k) / 10.0),
                2e-6)
        << k;
  }
  EXPECT_NEAR(errors[10], 0, 1e-6);
}

// One measurement, as sure as what the odometry has there: on each of the three axes the variance
// is halved, which is half of log 2 an axis. The turns' variance is that of ten steps too.
TEST(PoseChainTest, InformationIsTheLogarithmOfWhatIsLeft) {
  const PoseChain chain(straight(), {1e-3, 1e-9});
  std::vector<Matrix6d> measured = nothing();
  measured[10].topLeftCorner<3, 3>() = Eigen::Matrix3d::Identity() / (10 * 1e-6);
  const double once = chain.information(measured);
  EXPECT_NEAR(once, 3 * 0.5 * std::log(2.0), 1e-4);
  measured[10] *= 2;
  EXPECT_NEAR(chain.information(measured), 3 * 0.5 * std::log(3.0), 1e-4);
  EXPECT_LT(chain.information(measured) - once, once);
}

TEST(PoseChainTest, AShareOfErrors) {
  EXPECT_DOUBLE_EQ(share_of({3, 1, 2, 5, 4}, 0.5), 3);
  EXPECT_DOUBLE_EQ(share_of({3, 1, 2, 5, 4}, 1), 5);
}

}  // namespace
}  // namespace vinebench::harness
