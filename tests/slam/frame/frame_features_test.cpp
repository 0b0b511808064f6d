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

TEST(FrameFeaturesTest, LandmarksOfAllViewsOnceAscending) {
  EXPECT_THAT(landmark_ids({{7, -1, 2}, {2, 9, -1}}), testing::ElementsAre(2, 7, 9));
  EXPECT_TRUE(landmark_ids({{-1}, {}}).empty());
}

}  // namespace
}  // namespace vinebench::slam
