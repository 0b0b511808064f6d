// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/solver/terms.h"

#include <gtest/gtest.h>

#include "slam/factors/relative_pose_factor.h"
#include "tests/support/loop_problem.h"

namespace vinebench::slam {
namespace {

using test::LoopProblem;

TEST(TermsTest, SightsStandByPointAndThenByPose) {
  LoopProblem loop(20, 40, 0);
  const Terms terms = read_terms(loop.problem, loop.unknowns);
  EXPECT_EQ(terms.sights.size(), loop.factors.size());
  ASSERT_EQ(terms.first.size(), 41u);
  EXPECT_EQ(terms.first.back(), terms.sights.size());
  for (std::size_t p = 0; p < 40; ++p) {
    for (std::size_t s = terms.first[p] + 1; s < terms.first[p + 1]; ++s) {
      EXPECT_LT(terms.sights[s - 1].pose, terms.sights[s].pose);
    }
  }
}

TEST(TermsTest, WhatIsHeldIsNoUnknown) {
  LoopProblem loop(20, 40, 0);
  const Terms terms = read_terms(loop.problem, loop.unknowns);
  ASSERT_EQ(terms.poses.size(), 19u);  // of 20, the first is held
  EXPECT_EQ(terms.chain, 19u);
  EXPECT_EQ(terms.poses[0].block, loop.poses[1].data());
  for (const Sight& sight : terms.sights) {
    EXPECT_EQ(sight.pose.has_value(), sight.block != loop.poses[0].data());
  }
}

TEST(TermsTest, FactorsOfPosesAreTies) {
  LoopProblem loop(20, 40, 0);
  RelativePoseFactor factor({}, Matrix6d::Identity());
  loop.problem.AddResidualBlock(&factor, nullptr, loop.poses[0].data(), loop.poses[7].data());
  const Terms terms = read_terms(loop.problem, loop.unknowns);
  ASSERT_EQ(terms.ties.size(), 1u);
  EXPECT_EQ(terms.ties[0].count, 2u);
  EXPECT_FALSE(terms.ties[0].poses[0]);
  EXPECT_EQ(terms.ties[0].poses[1], 6u);
}

TEST(TermsTest, SquaresAreWeighedByTheirLoss) {
  EXPECT_EQ(weigh(nullptr, 9).cost, 4.5);
  EXPECT_EQ(weigh(nullptr, 9).scale, 1);
  // Cauchy of scale 2: 4 log(1 + s / 4), with the derivative 1 / (1 + s / 4); s = 12.
  const ceres::CauchyLoss cauchy(2);
  EXPECT_DOUBLE_EQ(weigh(&cauchy, 12).cost, 2 * std::log(4.0));
  EXPECT_DOUBLE_EQ(weigh(&cauchy, 12).scale, 0.5);
}

TEST(TermsTest, TheirCostIsTheProblems) {
  ceres::CauchyLoss cauchy(1);
  LoopProblem loop(20, 40, 0.02, &cauchy);
  RelativePoseFactor factor({}, Matrix6d::Identity());
  loop.problem.AddResidualBlock(&factor, nullptr, loop.poses[0].data(), loop.poses[7].data());
  const double cost = loop.cost();
  EXPECT_NEAR(cost_of(read_terms(loop.problem, loop.unknowns)), cost, 1e-12 * cost);
}

}  // namespace
}  // namespace vinebench::slam
