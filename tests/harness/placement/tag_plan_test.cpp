// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/placement/tag_plan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/geometry/step_covariance.h"

namespace vinebench::harness {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// A drive of 60 m, with a candidate at every fifth pose that is seen from there alone.
class TagPlanTest : public testing::Test {
 protected:
  TagPlanTest() {
    std::vector<Pose> poses;
    for (int k = 0; k <= 60; ++k) poses.push_back({{1, 0, 0, 0}, {1.0 * k, 0, 0}});
    chain_.emplace(poses, OdometryDrift{1e-3, 2e-4});
    const Matrix6d sure = isotropic_covariance(0.002, 0.01).inverse();
    for (std::size_t k = 5; k <= 60; k += 5) {
      candidates_.emplace_back();
      candidates_.back().information = {{k, sure}};
    }
  }

  /// What those two give.
  TagPlan pair(std::size_t a, std::size_t b) const {
    return predict_tags(*chain_, {candidates_[a], candidates_[b]});
  }

  std::optional<PoseChain> chain_;
  std::vector<TagCandidate> candidates_;
};

// All 66 pairs of the twelve candidates are tried beside.
TEST_F(TagPlanTest, IsAsGoodAsTheBestPair) {
  double least_error = 1e9;
  double most_information = 0;
  for (std::size_t a = 0; a < candidates_.size(); ++a) {
    for (std::size_t b = a + 1; b < candidates_.size(); ++b) {
      const TagPlan tried = pair(a, b);
      least_error = std::min(least_error, tried.error);
      most_information = std::max(most_information, tried.information);
    }
  }
  const TagPlan plan = plan_tags(*chain_, candidates_, {.budget = 2});
  ASSERT_EQ(plan.chosen.size(), 2u);
  EXPECT_NEAR(plan.error, least_error, 1e-9);
  EXPECT_GE(plan.most_information, most_information);
  EXPECT_LT(plan.error, predict_tags(*chain_, {}).error);
}

TEST_F(TagPlanTest, AsFewAsKeepTheError) {
  const double two = plan_tags(*chain_, candidates_, {.budget = 2}).error;
  const double three = plan_tags(*chain_, candidates_, {.budget = 3}).error;
  ASSERT_LT(three, two);
  const TagPlan plan = plan_tags(*chain_, candidates_, {.budget = 12, .error = three});
  EXPECT_LE(plan.chosen.size(), 3u);
  EXPECT_LE(plan.error, three);
  // Less than all of them can give.
  const TagPlan all = plan_tags(*chain_, candidates_, {.budget = 12, .error = 1e-6});
  EXPECT_EQ(all.chosen.size(), 12u);
}

TEST_F(TagPlanTest, WhatNobodySeesIsNotHung) {
  for (std::size_t c = 1; c < candidates_.size(); ++c) candidates_[c].information.clear();
  EXPECT_THAT(plan_tags(*chain_, candidates_, {.budget = 5}).chosen, ElementsAre(0));
  candidates_[0].information.clear();
  EXPECT_THAT(plan_tags(*chain_, candidates_, {.budget = 5}).chosen, IsEmpty());
}

}  // namespace
}  // namespace vinebench::harness
