// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/solver/terms.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "slam/factors/relative_pose_factor.h"
#include "tests/support/loop_problem.h"

namespace vinebench::slam {
namespace {

using test::LoopProblem;

TEST(TermsTest, SightsStandByPointAndThenByPose) {
  LoopProblem loop(20, 40, 0);
  std::vector<Sight>& sights = loop.unknowns.sights;
  std::ranges::reverse(sights);  // the later pose first
  std::ranges::stable_sort(sights, {}, &Sight::point);
  const Terms terms = read_terms(loop.problem, loop.unknowns);
  ASSERT_EQ(terms.first.size(), 41u);
  EXPECT_EQ(terms.first.back(), sights.size());
  for (std::size_t p = 0; p < 40; ++p) {
    for (std::size_t s = terms.first[p]; s < terms.first[p + 1]; ++s) {
      const auto& [sight, pose] = terms.sights[s];
      EXPECT_EQ(sights[sight].point, p);
      EXPECT_EQ(sights[sight].pose, pose);
      EXPECT_TRUE(s == terms.first[p] || pose > terms.sights[s - 1].pose);
    }
  }
}

TEST(TermsTest, PointsThatNothingSeesHaveNoSights) {
  LoopProblem loop(20, 3, 0);
  std::vector<Sight>& sights = loop.unknowns.sights;
  std::erase_if(sights, [](const Sight& s) { return s.point != 1; });
  const Terms terms = read_terms(loop.problem, loop.unknowns);
  const std::vector<std::size_t> expected{0, 0, sights.size(), sights.size()};
  EXPECT_EQ(terms.first, expected);
}

TEST(TermsTest, WhatIsHeldHasNoRow) {
  LoopProblem loop(20, 40, 0);
  const Terms terms = read_terms(loop.problem, loop.unknowns);
  ASSERT_EQ(terms.rows.size(), 19u);  // of 20, the first is held
  EXPECT_EQ(terms.chain, 19u);
  EXPECT_EQ(terms.rows[0].block, loop.poses[1].data());
  EXPECT_FALSE(terms.row_of[0]);
  EXPECT_EQ(terms.row_of[19], 18u);
}

TEST(TermsTest, FactorsOfPosesAreTies) {
  LoopProblem loop(20, 40, 0);
  RelativePoseFactor factor({}, Matrix6d::Identity());
  loop.tie(factor, {loop.poses[0].data(), loop.poses[7].data()});
  const Terms terms = read_terms(loop.problem, loop.unknowns);
  ASSERT_EQ(terms.ties.size(), 1u);
  EXPECT_EQ(terms.ties[0].count, 2u);
  EXPECT_FALSE(terms.ties[0].rows[0]);
  EXPECT_EQ(terms.ties[0].rows[1], 6u);
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
  loop.tie(factor, {loop.poses[0].data(), loop.poses[7].data()});
  const double cost = loop.whole_cost();
  EXPECT_NEAR(cost_of(read_terms(loop.problem, loop.unknowns)), cost, 1e-12 * cost);
}

}  // namespace
}  // namespace vinebench::slam
