// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/map/trajectory_record.h"

#include <gtest/gtest.h>

namespace vinebench::slam {
namespace {

Pose at(double x) {
  return {Eigen::Quaterniond::Identity(), {x, 0, 0}};
}

/// Two keyframes, 1 m apart along x.
class TrajectoryRecordTest : public testing::Test {
 protected:
  TrajectoryRecordTest() {
    for (const double x : {0.0, 1.0})
      map_.add_keyframe(std::make_shared<FrameFeatures>(), at(x), {});
  }
  void add(Stamp stamp, int keyframe, double x, bool reckoned) {
    record_.add(stamp, map_.keyframe(keyframe), at(x), reckoned);
  }

  Map map_{1.2};
  TrajectoryRecord record_;
};

TEST_F(TrajectoryRecordTest, PosesMoveWithTheirKeyframes) {
  add(1, 0, 0.5, false);
  add(2, 1, 1.5, false);
  map_.keyframe(1).T_map_body = at(1.25);
  const Trajectory trajectory = record_.trajectory(map_);
  ASSERT_EQ(trajectory.size(), 2u);
  EXPECT_EQ(trajectory[0].stamp, 1);
  EXPECT_EQ(trajectory[0].pose.translation.x(), 0.5);
  EXPECT_EQ(trajectory[1].pose.translation.x(), 1.75);  // 0.5 m after a keyframe that is at 1.25 m
}

TEST_F(TrajectoryRecordTest, OnlyReckonedPosesOfThatKeyframeAreWithdrawn) {
  add(1, 0, 0.25, true);
  add(2, 1, 1.25, false);
  add(3, 1, 1.5, true);
  record_.withdraw_reckoned(1);
  const Trajectory trajectory = record_.trajectory(map_);
  ASSERT_EQ(trajectory.size(), 2u);
  EXPECT_EQ(trajectory[0].stamp, 1);
  EXPECT_EQ(trajectory[1].stamp, 2);
}

}  // namespace
}  // namespace vinebench::slam
