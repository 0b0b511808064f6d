// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/factors/calibration_belief.h"

#include <gtest/gtest.h>

namespace vinebench::slam {
namespace {

TEST(CalibrationBeliefTest, VectorsAndCalibrationsAreTheSame) {
  const Eigen::VectorXd unknowns = Eigen::VectorXd::LinSpaced(38, -0.01, 0.02);
  const RigCalibration rig = from_vector(unknowns, 2);
  const std::vector<PairCalibration>& pairs = rig.pairs;
  ASSERT_EQ(pairs.size(), 2u);
  EXPECT_EQ(pairs[1].disparity_offset, unknowns[24]);
  EXPECT_EQ(pairs[1].readout, unknowns[29]);
  EXPECT_EQ(pairs[1].principal_point, unknowns.segment<2>(30));
  EXPECT_EQ(pairs[1].right_turn, unknowns.segment<3>(32));
  EXPECT_EQ(pairs[1].right_ahead, unknowns[35]);
  EXPECT_EQ(pairs[0].T_nominal_camera.translation, unknowns.head<3>());
  EXPECT_EQ(rig.tag_times, (std::vector<double>{unknowns[36], unknowns[37]}));
  EXPECT_LT((to_vector(rig) - unknowns).norm(), 1e-15);
}

// Two measurements of 1 and 3 with standard deviations of 1 and 1 / sqrt(3): the mean is
// (1 + 3 * 3) / 4, its variance 1 / 4.
TEST(CalibrationBeliefTest, WhatPartsSayAddsUp) {
  CalibrationBelief one = CalibrationBelief::nothing(1), three = one;
  one.information.setIdentity();
  one.information_vector.setOnes();
  three.information = one.information * 3;
  three.information_vector = three.information * Eigen::VectorXd::Constant(18, 3);
  const CalibrationBelief sum = one + three;
  EXPECT_LT((sum.mean() - Eigen::VectorXd::Constant(18, 2.5)).norm(), 1e-12);
  EXPECT_NEAR(sum.covariance()(0, 0), 0.25, 1e-12);
  EXPECT_NEAR((sum * 2).covariance()(0, 0), 0.125, 1e-12);
}

}  // namespace
}  // namespace vinebench::slam
