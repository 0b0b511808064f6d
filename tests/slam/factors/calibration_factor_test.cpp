// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/factors/calibration_factor.h"

#include <gtest/gtest.h>

#include "tests/support/factor_check.h"

namespace vinebench::slam {
namespace {

/// Two pairs and a camera for tags whose numbers all depend on each other.
CalibrationBelief mixed_belief() {
  CalibrationBelief belief = CalibrationBelief::nothing(2, 1);
  for (Eigen::Index i = 0; i < 37; ++i) {
    for (Eigen::Index j = 0; j < 37; ++j) belief.information(i, j) = i == j ? 4 : 1.0 / (1 + i + j);
  }
  belief.information_vector = belief.information * Eigen::VectorXd::LinSpaced(37, -0.002, 0.004);
  return belief;
}

const std::vector<Pose> kNominal{{exp_so3({0.1, -1.2, 0.4}), {0.2, 0.1, 0.3}},
                                 {exp_so3({0, 2, 0.1}), {-0.2, 0, 0.3}}};

// The factor's rotation vector is good to the first order of a turn of 0.01 rad: 1e-5 of the
// information's root of about 2.
TEST(CalibrationFactorTest, JacobiansAreTheNumericOnes) {
  const Pose off = step_of((Vector6d() << 0.003, -0.001, 0.002, 0.004, 0.006, -0.008).finished());
  test::expect_jacobian(CalibrationFactor(kNominal, mixed_belief()),
                        {test::as_vector(to_block(kNominal[0] * off)),
                         {0.3, 0, 0.01, 0, 0.005, 0.02, 0.4, 0, 0, 0.003, 0, 0},
                         test::as_vector(to_block(kNominal[1])),
                         {-0.1, 0.001, 0, 0.002, 0, 0, 0, -0.2, 0, 0, 0, 0.001},
                         {0.02}});
}

// With standard deviations of 1 mm, 2 mrad, 0.5 px, 5 ms of the tag camera's time and 1 of the
// rest: 3 mm, 4 mrad, 1 px, 0.1 of the pair's last and 10 ms are 3, 2, 2, 0.1 and 2 of them.
TEST(CalibrationFactorTest, ResidualsAreStandardDeviations) {
  CalibrationBelief belief = CalibrationBelief::nothing(1, 1);
  belief.information.setIdentity();
  belief.information.diagonal().head<7>() << Eigen::Vector3d::Constant(1e6),
      Eigen::Vector3d::Constant(2.5e5), 4;
  belief.information(18, 18) = 4e4;
  const CalibrationFactor factor({kNominal[0]}, belief);
  const Pose off = step_of((Vector6d() << 0, 0.003, 0, 0.004, 0, 0).finished());
  const PoseBlock camera = to_block(kNominal[0] * off);
  const std::array<double, kLensUnknowns> lens{1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0.1};
  const double time = 0.01;
  const double* parameters[] = {camera.data(), lens.data(), &time};
  Eigen::Matrix<double, kPairUnknowns + 1, 1> residuals;
  ASSERT_TRUE(factor.Evaluate(parameters, residuals.data(), nullptr));
  Eigen::Matrix<double, kPairUnknowns + 1, 1> expected;
  expected << 0, 3, 0, 2, 0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0.1, 2;
  EXPECT_LT((residuals - expected).norm(), 1e-9);
}

}  // namespace
}  // namespace vinebench::slam
