// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/optimisation/adjustment_window.h"

#include <gtest/gtest.h>

#include <memory>

namespace vinebench::slam {
namespace {

/// Frames whose features are only indices.
Map chain() {
  Map map(1.2);
  auto frame = std::make_shared<FrameFeatures>();
  frame->views.resize(1);
  frame->views[0].features.keypoints.resize(20);
  frame->views[0].features.descriptors.resize(20);
  for (int k = 0; k < 6; ++k) map.add_keyframe(frame, Pose{}, {});
  // Keyframe k shares landmarks with k + 1 only: five with the last, k + 1 with the others.
  for (int k = 0; k < 5; ++k) {
    for (int i = 0; i < k + 1; ++i) {
      const int id = map.add_landmark({0, 0, 1}, {k, 0, i});
      map.add_observation(id, {k + 1, 0, 10 + i});
    }
  }
  return map;
}

TEST(LocalWindowTest, IsTheKeyframeItsNeighboursAndTheirs) {
  const Map map = chain();
  const AdjustmentWindow last = local_window(map, 5, 10);
  EXPECT_EQ(last.moved, (std::vector<int>{4, 5}));
  EXPECT_EQ(last.fixed, (std::vector<int>{0, 3}));  // the first is always fixed
  const AdjustmentWindow small = local_window(map, 3, 2);
  EXPECT_EQ(small.moved, (std::vector<int>{3, 4}));  // 4 shares more with 3 than 2 does
  EXPECT_EQ(small.fixed, (std::vector<int>{0, 2, 5}));
  const AdjustmentWindow first = local_window(map, 1, 10);
  EXPECT_EQ(first.moved, (std::vector<int>{1, 2}));
  EXPECT_EQ(first.fixed, (std::vector<int>{0, 3}));
}

TEST(LocalWindowTest, AKeyframeThatRestartsTheMapIsFixed) {
  Map map = chain();
  map.keyframe(4).link = OdometryLink{3, {}, Matrix6d::Identity()};
  const AdjustmentWindow window = local_window(map, 5, 10);
  EXPECT_EQ(window.moved, (std::vector<int>{5}));
  EXPECT_EQ(window.fixed, (std::vector<int>{0, 4}));  // 3 shares nothing with 5
}

TEST(GlobalWindowTest, TheFirstKeyframeHoldsTheMapUnlessATagDoes) {
  Map map = chain();
  map.tags().push_back({"tag36h11", 1, 0.16, {}, false});
  EXPECT_EQ(global_window(map).fixed, (std::vector<int>{0}));
  EXPECT_EQ(global_window(map).moved, (std::vector<int>{1, 2, 3, 4, 5}));
  map.tags().push_back({"tag36h11", 2, 0.16, {}, true});
  EXPECT_TRUE(global_window(map).fixed.empty());
  EXPECT_EQ(global_window(map).moved.size(), 6u);
}

}  // namespace
}  // namespace vinebench::slam
