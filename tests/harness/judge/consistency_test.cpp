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

TEST(ConsistencyTest, ARegisteredTagMustBeInTheFirstFrame) {
  RunRecord record = record_with({0.01, 0.01});
  record.ticks[0].estimate.tags.clear();
  EXPECT_FALSE(check_consistency(record));
  EXPECT_FALSE(check_consistency(RunRecord{}));
}

// The map begins where the first pose is, at 1 sigma behind the world's, and a loop moves it there.
TEST(ConsistencyTest, BeforeARegisteredTagHasASayErrorsCountFromTheFirstPose) {
  RunRecord record = record_with({0.01, 0.01, 0.01, 0.05, 0.05});
  for (std::size_t i = 0; i < record.ticks.size(); ++i) {
    Tick& tick = record.ticks[i];
    tick.truth.T_world_body = {Eigen::Quaterniond::Identity(), {static_cast<double>(i), 0, 0}};
    tick.estimate.T_map_body = tick.truth.T_world_body;
    tick.estimate.T_map_body->translation.x() += i == 0 ? 0.01 : 0.03;  // 2 sigma on from the first
  }
  record.ticks[0].estimate.covariance = Vector6d::Constant(1e-12).asDiagonal();
  record.ticks[3].estimate.loop_closure = LoopClosure{};
  const TagSighting& seen = record.ticks[0].estimate.tags[0];
  record.ticks[0].estimate.rejected_tags.push_back(
      {seen.family, seen.id, seen.camera, TagRejection::kAmbiguous});
  const auto found = check_consistency(record);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->frames, 2);
  EXPECT_NEAR(found->nees_mean, 4, 1e-9);
  // Nothing in view at all is the same.
  record.ticks[0].estimate.tags.clear();
  record.ticks[0].estimate.rejected_tags.clear();
  EXPECT_EQ(check_consistency(record)->frames, 2);
  // Another camera's sighting is another one.
  record.ticks[0].estimate.tags.push_back(record_with({0}).ticks[0].estimate.tags[0]);
  record.ticks[0].estimate.rejected_tags.push_back(
      {record.tags[0].family, record.tags[0].id, 7, TagRejection::kAmbiguous});
  EXPECT_EQ(check_consistency(record)->frames, 5);
}

TEST(ConsistencyTest, OfARecordingTheTagsThatWereToldAreRegistered) {
  RunRecord record = record_with({0.01, 0.02});
  const WorldTag tag = record.tags[0];
  record.tags.clear();
  record.told_tags.push_back({tag.family, tag.id, tag.size, tag.T_world_tag});
  ASSERT_TRUE(check_consistency(record));
  EXPECT_NEAR(check_consistency(record)->nees_mean, 2.5, 1e-9);  // (1 + 4) / 2
  record.told_tags[0].id += 1;  // another one was told, which is not in view
  EXPECT_FALSE(check_consistency(record));
}

TEST(ConsistencyTest, WithoutRegisteredTagsErrorsCountFromTheFirstPose) {
  // Along a straight line, where offsets ahead subtract: 0, 1, 2 and 3 sigma more than at first.
  const std::vector<double> offset{0.01, 0.02, 0.03, 0.04};
  RunRecord record = record_with(offset);
  record.tags[0].registered = false;
  const Pose T_map_world{Eigen::Quaterniond(Eigen::AngleAxisd(1, Eigen::Vector3d::UnitZ())),
                         {3, 2, 1}};
  for (std::size_t i = 0; i < record.ticks.size(); ++i) {
    Tick& tick = record.ticks[i];
    tick.truth.T_world_body = {Eigen::Quaterniond::Identity(), {static_cast<double>(i), 0, 0}};
    tick.estimate.T_map_body = T_map_world * tick.truth.T_world_body;
    tick.estimate.T_map_body->translation +=
        T_map_world.rotation * Eigen::Vector3d(-offset[i], 0, 0);
  }
  const auto found = check_consistency(record);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->frames, 3);  // the first says nothing
  EXPECT_NEAR(found->nees_mean, 14.0 / 3, 1e-9);
  record.ticks[0].truth.known = false;
  EXPECT_FALSE(check_consistency(record));
}

}  // namespace
}  // namespace vinebench::harness
