// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/loop/adjusted_map.h"

#include <gtest/gtest.h>

#include "slam/optimisation/bundle_adjustment.h"
#include "tests/support/aisle_map.h"

namespace vinebench::slam {
namespace {

using test::distance;

/// Three keyframes of the aisle, and a fourth that comes while a copy of them is adjusted.
class AdjustedMapTest : public testing::Test {
 protected:
  static Pose truth(int keyframe) { return {exp_so3({0, 0, 0.02}), {0.1 * keyframe, 0, 0}}; }

  /// Moves the copy's last keyframe, and what it saw first, by 5 cm.
  static void shift(Map& copy) {
    Keyframe& last = copy.keyframes().back();
    last.T_map_body.translation.y() += 0.05;
    for (Landmark& landmark : copy.landmarks()) {
      if (landmark.first_keyframe == last.id) landmark.position.y() += 0.05;
    }
  }

  AdjustedMap adjusted() const { return adjust_copy(copy_for_adjustment(known_.map), shift); }

  test::SyntheticAisle aisle_{0, 1, 500};
  test::AisleMap known_{aisle_, {truth(0), truth(1), truth(2)}};
};

TEST_F(AdjustedMapTest, WhatCameSinceMovesWithTheLastThatIsKnown) {
  const Map before = known_.map;
  const AdjustedMap copy = adjusted();
  EXPECT_EQ(distance(known_.map.keyframe(2).T_map_body, truth(2)), 0);  // a copy
  const int newest = known_.add(aisle_.frame(3, truth(3)), truth(3));
  known_.map.tags().push_back({"tag36h11", 7, 0.161, truth(3)});
  const Pose T_new_old = take_over(copy, known_.map);
  EXPECT_LT((T_new_old.translation - Eigen::Vector3d(0, 0.05, 0)).norm(), 1e-12);
  EXPECT_EQ(distance(known_.map.keyframe(1).T_map_body, truth(1)), 0);
  for (const int id : {2, newest}) {
    const Pose& now = known_.map.keyframe(id).T_map_body;
    EXPECT_LT((now.translation - truth(id).translation - T_new_old.translation).norm(), 1e-12);
  }
  EXPECT_NEAR(known_.map.tags()[0].T_map_tag.translation.y(), 0.05, 1e-12);
  int of_last = 0;
  for (const Landmark& landmark : known_.map.landmarks()) {
    const bool moved = landmark.first_keyframe >= 2;
    const auto id = static_cast<std::size_t>(landmark.id);
    const Eigen::Vector3d was =
        id < before.landmarks().size() ? before.landmark(landmark.id).position : landmark.position;
    of_last += landmark.first_keyframe == 2;
    if (id < before.landmarks().size()) {
      EXPECT_NEAR(landmark.position.y() - was.y(), moved ? 0.05 : 0, 1e-12) << id;
    }
  }
  EXPECT_GT(of_last, 0);
}

TEST_F(AdjustedMapTest, WhatTheAdjustmentTookOutIsTakenOut) {
  const Landmark seen = known_.map.landmarks().front();
  ASSERT_GT(seen.observations.size(), 1u);
  const AdjustedMap copy = adjust_copy(copy_for_adjustment(known_.map), [&](Map& map) {
    map.remove_observation(seen.id, seen.observations.front());
  });
  ASSERT_EQ(copy.removed.size(), 1u);
  take_over(copy, known_.map);
  EXPECT_EQ(known_.map.landmark(seen.id).observations.size(), seen.observations.size() - 1);
  // Once more: it is gone already, and its feature is not another landmark's to lose.
  take_over(copy, known_.map);
  EXPECT_EQ(known_.map.landmark(seen.id).observations.size(), seen.observations.size() - 1);
}

TEST_F(AdjustedMapTest, ATagThatItPlacedIsSure) {
  known_.map.tags().push_back({"tag36h11", 0, 0.161, Pose{}});
  known_.map.tags().back().sure = false;
  const AdjustedMap copy = adjust_copy(copy_for_adjustment(known_.map), [](Map& map) {
    map.tags()[0].T_map_tag.translation.x() = 0.1;
    map.tags()[0].sure = true;
  });
  take_over(copy, known_.map);
  EXPECT_EQ(known_.map.tags()[0].T_map_tag.translation.x(), 0.1);
  EXPECT_TRUE(known_.map.tags()[0].sure);
}

TEST_F(AdjustedMapTest, ALandmarkThatTheMapLostSinceStaysLost) {
  const AdjustedMap copy = adjusted();
  const int lost = known_.map.landmarks().back().id;
  known_.map.remove_landmark(lost);
  take_over(copy, known_.map);
  EXPECT_TRUE(known_.map.landmark(lost).removed);
}

TEST_F(AdjustedMapTest, TheCopyIsAdjustedAsTheMapWouldBe) {
  known_.map.keyframe(2).T_map_body.translation.x() += 0.01;
  const auto adjust_it = [&](Map& map) {
    adjust(map, global_window(map), known_.rig, AdjustmentOptions{});
  };
  Map directly = known_.map;
  adjust_it(directly);
  take_over(adjust_copy(copy_for_adjustment(known_.map), adjust_it), known_.map);
  for (const Keyframe& keyframe : directly.keyframes()) {
    EXPECT_EQ(distance(known_.map.keyframe(keyframe.id).T_map_body, keyframe.T_map_body), 0);
  }
  for (const Landmark& landmark : directly.landmarks()) {
    const Landmark& mine = known_.map.landmark(landmark.id);
    EXPECT_EQ(mine.observations.size(), landmark.observations.size());
    EXPECT_TRUE(landmark.removed || mine.position == landmark.position) << landmark.id;
  }
}

}  // namespace
}  // namespace vinebench::slam
