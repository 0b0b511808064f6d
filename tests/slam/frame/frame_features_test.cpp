// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/frame/frame_features.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vinebench::slam {
namespace {

TEST(FrameFeaturesTest, AFrameBeginsWithoutAssociations) {
  FrameFeatures frame;
  frame.views.resize(2);
  frame.views[1].features.keypoints.resize(3);
  frame.views[1].features.descriptors.resize(3);
  const Associations none = no_associations(frame);
  ASSERT_EQ(none.size(), 2u);
  EXPECT_TRUE(none[0].empty());
  EXPECT_THAT(none[1], testing::ElementsAre(-1, -1, -1));
}

TEST(FrameFeaturesTest, FollowedFeaturesCanBeTakenOutAgain) {
  StereoView view;
  view.features.keypoints.resize(5);
  view.features.descriptors.resize(5);
  view.stereo.resize(5);
  view.placed.assign(5, 1);
  view.features.keypoints[2].x = 7;
  view.followed = 2;
  view.drop_followed();
  EXPECT_EQ(view.features.size(), 3u);
  EXPECT_EQ(view.features.descriptors.size(), 3u);
  EXPECT_EQ(view.stereo.size(), 3u);
  EXPECT_EQ(view.placed.size(), 3u);
  EXPECT_EQ(view.features.keypoints.back().x, 7);
  EXPECT_EQ(view.detected(), 3u);
}

TEST(FrameFeaturesTest, LandmarksOfAllViewsOnceAscending) {
  EXPECT_THAT(landmark_ids({{7, -1, 2}, {2, 9, -1}}), testing::ElementsAre(2, 7, 9));
  EXPECT_TRUE(landmark_ids({{-1}, {}}).empty());
}

}  // namespace
}  // namespace vinebench::slam
