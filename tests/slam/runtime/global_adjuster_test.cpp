// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/runtime/global_adjuster.h"

#include <gtest/gtest.h>

#include "tests/support/loop_closure_case.h"

namespace vinebench::slam {
namespace {

/// A loop that was closed without adjusting the map.
class GlobalAdjusterTest : public test_case::LoopClosureTest {
 protected:
  GlobalAdjusterTest() { drive_and_close(loop_, false, false); }

  LoopCloser loop_ = closer();
  GlobalAdjuster adjuster_;
  StageTimes times_;
};

TEST_F(GlobalAdjusterTest, FindsWhatAnAdjustmentAtOnceWouldFind) {
  EXPECT_FALSE(adjuster_.busy());
  adjuster_.start(loop_, known_.rig, known_.map);
  EXPECT_TRUE(adjuster_.busy());
  EXPECT_FALSE(adjuster_.due());
  const Pose before = known_.map.keyframe(5).T_map_body;
  const auto T_new_old = adjuster_.join(known_.map, times_);
  ASSERT_TRUE(T_new_old);
  EXPECT_LT(test::distance(*T_new_old * before, known_.map.keyframe(5).T_map_body), 1e-12);
  expect_true_poses();
  EXPECT_FALSE(adjuster_.busy());
}

TEST_F(GlobalAdjusterTest, WhatWasOutdatedIsDropped) {
  adjuster_.outdate();  // of none under way
  EXPECT_FALSE(adjuster_.due());
  adjuster_.start(loop_, known_.rig, known_.map);
  adjuster_.outdate();
  const Pose before = known_.map.keyframe(4).T_map_body;
  EXPECT_FALSE(adjuster_.join(known_.map, times_));
  EXPECT_EQ(test::distance(known_.map.keyframe(4).T_map_body, before), 0);
  EXPECT_TRUE(adjuster_.due());
  adjuster_.start(loop_, known_.rig, known_.map);
  EXPECT_FALSE(adjuster_.due());
  EXPECT_TRUE(adjuster_.join(known_.map, times_));
  expect_true_poses();
}

TEST_F(GlobalAdjusterTest, AskedAgainItIsTakenOverAndAnotherIsWanted) {
  adjuster_.want();
  EXPECT_TRUE(adjuster_.due());
  adjuster_.start(loop_, known_.rig, known_.map);
  adjuster_.want();
  EXPECT_FALSE(adjuster_.due());
  EXPECT_TRUE(adjuster_.join(known_.map, times_));
  EXPECT_TRUE(adjuster_.due());
  expect_true_poses();
}

// What happens to the map once it is copied makes no difference to what is found.
TEST_F(GlobalAdjusterTest, TheMapIsFreeOnceItIsCopied) {
  adjuster_.start(loop_, known_.rig, known_.map);
  adjuster_.wait_for_copy();
  for (Landmark& landmark : known_.map.landmarks()) landmark.position.setZero();
  EXPECT_TRUE(adjuster_.join(known_.map, times_));
  expect_true_poses();
}

}  // namespace
}  // namespace vinebench::slam
