// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/judge/consistency.h"

#include <gtest/gtest.h>

#include "tests/support/fakes.h"

namespace vinebench::harness {
namespace {

/// Poses off by `offset` along the body's x axis, with standard deviations of 1 cm and 0.01 rad;
/// the first frame saw the tag.
RunRecord record_with(const std::vector<double>& offsets) {
  RunRecord record;
  record.rig = test::fake_rig();
  record.tags = test::fake_trial().site.tags;
  for (std::size_t i = 0; i < offsets.size(); ++i) {
    Tick tick;
    tick.stamp = stamp_of_frame(static_cast<std::int64_t>(i), test::kFakeRate);
    tick.truth.T_world_body = test::circle(tick.stamp);
    tick.estimate.T_map_body =
        tick.truth.T_world_body * Pose{Eigen::Quaterniond::Identity(), {-offsets[i], 0, 0}};
    tick.estimate.covariance = Vector6d::Constant(1e-4).asDiagonal();
    record.ticks.push_back(tick);
  }
  TagSighting seen;
  seen.family = record.tags[0].family;
  seen.id = record.tags[0].id;
  record.ticks[0].estimate.tags.push_back(seen);
  return record;
}

TEST(ConsistencyTest, IsTheErrorInStandardDeviationsSquared) {
  // 1, 2, 3 and 4 sigma: (1 + 4 + 9 + 16) / 4 = 7.5; 16 is above 12.59.
  const auto found = check_consistency(record_with({0.01, 0.02, 0.03, 0.04}));
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->nees_mean, 7.5, 1e-9);
  EXPECT_DOUBLE_EQ(found->within_95, 0.75);
}

TEST(ConsistencyTest, FramesWithoutPoseTruthOrCovarianceAreLeftOut) {
  RunRecord record = record_with({0.01, 0.05, 0.05, 0.05});
  record.ticks[1].estimate.T_map_body.reset();
  record.ticks[2].truth.known = false;
  record.ticks[3].estimate.covariance.setZero();
  EXPECT_NEAR(check_consistency(record)->nees_mean, 1, 1e-9);
}

TEST(ConsistencyTest, CountsWhatItLeavesOutForItsCovariance) {
  RunRecord record = record_with({0.01, 0.05, 0.05, 0.05});
  record.ticks[1].estimate.T_map_body.reset();  // has no pose: not counted
  record.ticks[2].estimate.covariance.setZero();
  record.ticks[3].estimate.covariance(0, 0) = 0;  // of rank five
  const auto found = check_consistency(record);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->frames, 1);
  EXPECT_EQ(found->not_invertible, 2);
  EXPECT_EQ(format_left_out(found),
            "consistency: 2 of 3 frames with a pose are left out, for their covariance cannot be "
            "inverted\n");
}

TEST(ConsistencyTest, SaysSoWhereNoCovarianceCanBeInverted) {
  RunRecord record = record_with({0.01, 0.01});
  for (Tick& tick : record.ticks) tick.estimate.covariance(0, 0) = -1e-4;
  ASSERT_TRUE(check_consistency(record));
  EXPECT_EQ(check_consistency(record)->frames, 0);
  EXPECT_EQ(check_consistency(record)->not_invertible, 2);
  for (Tick& tick : record.ticks) tick.estimate.covariance.setZero();  // a system without any
  EXPECT_FALSE(check_consistency(record));
  EXPECT_EQ(format_left_out(std::nullopt), "");
}

TEST(ConsistencyTest, NeedsARegisteredTagInTheFirstFrame) {
  RunRecord record = record_with({0.01, 0.01});
  record.tags[0].registered = false;
  EXPECT_FALSE(check_consistency(record));
  record = record_with({0.01, 0.01});
  record.ticks[0].estimate.tags.clear();
  EXPECT_FALSE(check_consistency(record));
  EXPECT_FALSE(check_consistency(RunRecord{}));
}

}  // namespace
}  // namespace vinebench::harness
