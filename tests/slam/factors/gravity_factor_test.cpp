// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/factors/gravity_factor.h"

#include <gtest/gtest.h>

#include "tests/support/factor_check.h"
#include "tests/support/swinging_body.h"

namespace vinebench::slam {
namespace {

using namespace test;

/// Poses at 1, 1.3 and 1.7 s.
class GravityFactorTest : public testing::Test {
 protected:
  static constexpr double kTimes[] = {1.0, 1.3, 1.7};

  std::vector<std::vector<double>> blocks(const Eigen::Vector3d& bias) const {
    std::vector<std::vector<double>> all;
    for (const double t : kTimes) all.push_back(as_vector(to_block(SwingingBody::pose(t))));
    all.push_back(
        {body_.gravity.x(), body_.gravity.y(), body_.gravity.z(), bias.x(), bias.y(), bias.z()});
    return all;
  }

  GravityFactor factor(double sigma, const Eigen::Vector3d& bias = Eigen::Vector3d::Zero(),
                       const Eigen::Vector3d& taken = Eigen::Vector3d::Zero()) const {
    return {body_.motion(kTimes[0], kTimes[1], bias, taken),
            body_.motion(kTimes[1], kTimes[2], bias, taken), sigma};
  }

  static Eigen::Vector3d residual(const GravityFactor& factor,
                                  const std::vector<std::vector<double>>& blocks) {
    std::vector<const double*> parameters;
    for (const std::vector<double>& block : blocks) parameters.push_back(block.data());
    Eigen::Vector3d r;
    EXPECT_TRUE(factor.Evaluate(parameters.data(), r.data(), nullptr));
    return r;
  }

  SwingingBody body_;
};

// Steps of 1 ms and the differences' rounding (1e-16 / 1e-8) leave some 1e-5 m/s^2.
TEST_F(GravityFactorTest, TheTrueMotionFeelsGravity) {
  EXPECT_NEAR(residual(factor(1), blocks({0, 0, 0})).norm(), 0, 3e-5);
}

TEST_F(GravityFactorTest, TheBiasMayBeAnotherThanWasTakenAway) {
  const Eigen::Vector3d bias(0.03, -0.04, 0.05);
  EXPECT_NEAR(residual(factor(1, bias, {0.01, 0.01, 0.01}), blocks(bias)).norm(), 0, 3e-5);
  // Not known, it is felt: as large as it is, turned by what the body turns in the 0.7 s.
  EXPECT_NEAR(residual(factor(1, bias), blocks({0, 0, 0})).norm(), bias.norm(), 1e-3);
}

// A gravity that is 0.02 m/s^2 stronger is off by two standard deviations of 0.01.
TEST_F(GravityFactorTest, CountsInStandardDeviations) {
  std::vector<std::vector<double>> other = blocks({0, 0, 0});
  for (int i = 0; i < 3; ++i) other[3][static_cast<std::size_t>(i)] *= 1 + 0.02 / 9.8;
  EXPECT_NEAR(residual(factor(0.01), other).norm(), 2, 3e-3);
}

// The middle pose 1 mm ahead: the first mean velocity is 1 mm / 0.3 s too fast, the second 1 mm /
// 0.4 s too slow, which is 5.83 mm/s in 0.35 s.
TEST_F(GravityFactorTest, FeelsAPoseThatIsOff) {
  std::vector<std::vector<double>> off = blocks({0, 0, 0});
  const Pose ahead =
      SwingingBody::pose(kTimes[1]) * Pose{Eigen::Quaterniond::Identity(), {1e-3, 0, 0}};
  off[1] = as_vector(to_block(ahead));
  EXPECT_NEAR(residual(factor(1), off).norm(), 1e-3 * (1 / 0.3 + 1 / 0.4) / 0.35, 5e-5);
}

TEST_F(GravityFactorTest, JacobiansAreTheNumericOnes) {
  expect_jacobian(factor(0.3, {0.03, 0, 0.02}), blocks({0.01, -0.02, 0.03}));
}

}  // namespace
}  // namespace vinebench::slam
