// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/factors/robust_loss.h"

#include <ceres/loss_function.h>
#include <gtest/gtest.h>

namespace vinebench::slam {
namespace {

/// Ceres gives (cost, weight, its derivative) of the same losses.
void expect_same(const RobustLoss& loss, const ceres::LossFunction& reference) {
  for (const double s : {0.0, 0.3, 1.0, 4.0, 5.99, 6.01, 50.0, 1e6}) {
    double rho[3];
    reference.Evaluate(s, rho);
    EXPECT_NEAR(loss.cost(s), rho[0], 1e-12 * (1 + rho[0])) << s;
    EXPECT_NEAR(loss.weight(s), rho[1], 1e-12) << s;
  }
}

TEST(RobustLossTest, AgreesWithCeres) {
  expect_same(RobustLoss::huber(2.4477), ceres::HuberLoss(2.4477));
  expect_same(RobustLoss::cauchy(1), ceres::CauchyLoss(1));
  expect_same(RobustLoss::cauchy(2.5), ceres::CauchyLoss(2.5));
}

TEST(RobustLossTest, OfResidualsIsHubersOrCauchys) {
  // Of 9 squared deviations, by the definitions: 2 k 3 - k^2 and ln(1 + 9).
  EXPECT_NEAR(residual_loss(ResidualLoss::kHuber).cost(9), 6 * 2.4477 - 2.4477 * 2.4477, 1e-12);
  EXPECT_NEAR(residual_loss(ResidualLoss::kCauchy).cost(9), 2.302585092994046, 1e-12);
}

}  // namespace
}  // namespace vinebench::slam
