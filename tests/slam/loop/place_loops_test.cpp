// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/loop/place_loops.h"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/support/aisle_map.h"

namespace vinebench::slam {
namespace {

using test::AisleMap;
using test::angle;
using test::distance;
using test::SyntheticAisle;

/// A drive along an aisle, 14 keyframes in 3.25 m, whose end is elsewhere: what comes after it is
/// told from 12 m of the way on.
class PlaceLoopsTest : public testing::Test {
 protected:
  PlaceLoopsTest() {
    for (const Keyframe& keyframe : made_.map.keyframes()) {
      const double way = keyframe.T_map_body.translation.x();
      EXPECT_FALSE(look(keyframe.id, way));
    }
  }

  std::optional<PlaceReturn> look(int keyframe, double way) {
    const Matrix6d covariance = (1e-6 + 1e-6 * keyframe) * Matrix6d::Identity();
    return loops_.look(keyframe, way, covariance, made_.map, made_.rig);
  }

  /// A keyframe from `truth` that tracking took to be elsewhere, with none of the map's landmarks.
  std::optional<PlaceReturn> come(const Pose& truth, const Pose& estimated, double way) {
    return come(aisle_, truth, estimated, way);
  }
  std::optional<PlaceReturn> come(const SyntheticAisle& aisle, const Pose& truth,
                                  const Pose& estimated, double way) {
    const auto frame = aisle.frame(static_cast<std::int64_t>(100 * way), truth);
    const int id = made_.map.add_keyframe(frame, estimated, no_associations(*frame));
    return look(id, way);
  }

  static Pose at(double x, double y = 0.05, double yaw = 0.1) {
    return {exp_so3({0, 0, yaw}), {x, y, 0}};
  }
  /// 12 m of the way allow for 0.1 + 0.005 x (12 - x) m, some 15 cm.
  static Pose drifted(const Pose& truth, double x = 0.05, double y = 0.03) {
    return Pose{exp_so3({0, 0, 0.01}), {x, y, 0}} * truth;
  }

  SyntheticAisle aisle_{0.5, 1, 1500};
  AisleMap made_{aisle_, test::straight_way()};
  PlaceLoops loops_{PlacesConfig{}};
};

TEST_F(PlaceLoopsTest, AReturnIsBelievedOnceTwoKeyframesAgree) {
  EXPECT_FALSE(come(at(1.6), drifted(at(1.6)), 12));
  const auto found = come(at(1.7), drifted(at(1.7)), 12.1);
  ASSERT_TRUE(found);
  // As of a relocalisation: 0.5 px at 263 px and one metre are 2 mm for one feature.
  EXPECT_LT(distance(found->T_map_body, at(1.7)), 0.002);
  EXPECT_LT(angle(found->T_map_body, at(1.7)), 0.002);
  EXPECT_EQ(found->earlier, 7);  // at 1.75 m
  EXPECT_DOUBLE_EQ(found->earlier_covariance(0, 0), 8e-6);
  EXPECT_FALSE(found->tied);
  EXPECT_GT(found->landmarks.size(), 100u);
  // A millimetre of matches and three of the place.
  EXPECT_LT(std::sqrt(found->covariance(0, 0)), 0.005);
  // It is known now, until as much way was driven elsewhere.
  EXPECT_FALSE(come(at(1.8), drifted(at(1.8)), 12.2));
  EXPECT_FALSE(come(at(1.9), drifted(at(1.9)), 12.3));
}

TEST_F(PlaceLoopsTest, AlsoInTheOppositeDirection) {
  const double about = std::numbers::pi + 0.1;
  EXPECT_FALSE(come(at(1.8, 0.05, about), drifted(at(1.8, 0.05, about)), 12));
  const auto found = come(at(1.7, 0.05, about), drifted(at(1.7, 0.05, about)), 12.1);
  ASSERT_TRUE(found);
  EXPECT_LT(distance(found->T_map_body, at(1.7, 0.05, about)), 0.002);
}

TEST_F(PlaceLoopsTest, ThatDisagreeIsNone) {
  EXPECT_FALSE(come(at(1.6), drifted(at(1.6), 0.05, 0.03), 12));
  EXPECT_FALSE(come(at(1.7), drifted(at(1.7), -0.05, 0.03), 12.1));  // 10 cm in a tenth of a metre
}

TEST_F(PlaceLoopsTest, BeyondWhatTheWayDriftsIsNone) {
  for (const double x : {1.6, 1.7, 1.8}) {
    EXPECT_FALSE(come(at(x), drifted(at(x), 0.3, 0), 12 + x)) << x;
  }
}

TEST_F(PlaceLoopsTest, AnotherAisleIsNone) {
  const SyntheticAisle other(0.5, 2, 1500);
  for (const double x : {1.6, 1.7, 1.8}) {
    EXPECT_FALSE(come(other, at(x), drifted(at(x)), 12 + x)) << x;
  }
}

TEST_F(PlaceLoopsTest, SoonAfterIsNone) {
  EXPECT_FALSE(come(at(1.6), drifted(at(1.6)), 4.8));
  EXPECT_FALSE(come(at(1.7), drifted(at(1.7)), 4.9));
}

// Where the drift is small tracking finds the old landmarks by itself: that is told at once, once.
TEST_F(PlaceLoopsTest, WhatTrackingFoundIsTold) {
  const auto frame = aisle_.frame(1200, at(1.7));
  const int id = made_.map.add_keyframe(frame, at(1.7), made_.associate(*frame));
  const auto found = look(id, 12);
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->tied);
  EXPECT_EQ(distance(found->T_map_body, at(1.7)), 0);
  EXPECT_NEAR(made_.map.keyframe(found->earlier).T_map_body.translation.x(), 1.7, 0.5);
  const auto next = aisle_.frame(1210, at(1.8));
  EXPECT_FALSE(look(made_.map.add_keyframe(next, at(1.8), made_.associate(*next)), 12.1));
}

}  // namespace
}  // namespace vinebench::slam
