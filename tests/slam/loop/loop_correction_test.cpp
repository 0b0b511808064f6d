// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/loop/loop_correction.h"

#include <gtest/gtest.h>

#include <numbers>

namespace vinebench::slam {
namespace {

/// Keyframes at these x, m, each with one landmark one metre to its left.
Map straight_map(const std::vector<double>& places) {
  Map map(1.2);
  for (const double x : places) {
    auto frame = std::make_shared<FrameFeatures>();
    frame->views.resize(1);
    const int id = map.add_keyframe(frame, {Eigen::Quaterniond::Identity(), {x, 0, 0}}, {{}});
    map.landmarks().emplace_back();
    map.landmarks().back().id = id;
    map.landmarks().back().first_keyframe = id;
    map.landmarks().back().position = {x, 1, 0};
  }
  return map;
}

Eigen::Vector3d place(const Map& map, int id) {
  return map.keyframe(id).T_map_body.translation;
}

Pose shifted(const Map& map, int id, const Eigen::Vector3d& shift) {
  return {Eigen::Quaterniond::Identity(), place(map, id) + shift};
}

// Along the path rotations have no influence: 0.3 m distributed over steps of 1 and 2 m.
TEST(SpreadCorrectionTest, SharesTheWayByItsLengthAndTakesLandmarksAlong) {
  Map map = straight_map({0, 1, 2, 4});
  spread_correction(map, 1, 3, shifted(map, 3, {0.3, 0, 0}), Matrix6d::Zero());
  EXPECT_LT((place(map, 0) - Eigen::Vector3d(0, 0, 0)).norm(), 1e-12);
  EXPECT_LT((place(map, 1) - Eigen::Vector3d(1, 0, 0)).norm(), 1e-12);
  EXPECT_LT((place(map, 2) - Eigen::Vector3d(2.1, 0, 0)).norm(), 1e-9);
  EXPECT_LT((place(map, 3) - Eigen::Vector3d(4.3, 0, 0)).norm(), 1e-9);
  EXPECT_LT((map.landmark(1).position - Eigen::Vector3d(1, 1, 0)).norm(), 1e-12);
  EXPECT_LT((map.landmark(2).position - Eigen::Vector3d(2.1, 1, 0)).norm(), 1e-9);
}

// The end is 1 cm to the side, its heading unknown. Of its variance across the path, 1e-6 m^2 is
// the first step's own, as much the second's, and (2e-4 rad)^2 (1 m)^2 = 4e-8 m^2 comes from the
// first step's rotation: these are the shares of the centimetre.
TEST(SpreadCorrectionTest, AnEarlyTurnSwingsWhatFollows) {
  Map map = straight_map({0, 1, 2});
  Matrix6d covariance = Matrix6d::Zero();
  covariance.bottomRightCorner<3, 3>() = 1e6 * Eigen::Matrix3d::Identity();
  spread_correction(map, 0, 2, shifted(map, 2, {0, 0.01, 0}), covariance);
  const double whole = 2 + 0.04;
  // To first order: the neglected term is the square of the rotation, 4e-8.
  EXPECT_NEAR(place(map, 1).y(), 0.01 / whole, 1e-7);
  EXPECT_NEAR(yaw_of(map.keyframe(1).T_map_body.rotation), 0.01 * 0.04 / whole, 1e-7);
  EXPECT_NEAR(place(map, 2).y(), 0.01, 1e-7);
}

// The heading is wrong by 10 mrad, and the end's position is correct: it stays there, up to second
// order, 4 m (10 mrad)^2 / 2, and rotates.
TEST(SpreadCorrectionTest, ATurnLeavesTheEndInItsPlace) {
  Map map = straight_map({0, 1, 2, 4});
  const Eigen::Quaterniond turned(Eigen::AngleAxisd(0.01, Eigen::Vector3d::UnitZ()));
  spread_correction(map, 0, 3, {turned, {4, 0, 0}}, Matrix6d::Zero());
  EXPECT_LT((place(map, 3) - Eigen::Vector3d(4, 0, 0)).norm(), 2e-4);
  EXPECT_NEAR(yaw_of(map.keyframe(3).T_map_body.rotation), 0.01, 1e-4);
}

// As uncertain as the path of 4 m, 4e-6 m^2, the tag has half of the weight.
TEST(SpreadCorrectionTest, AnUncertainTagIsBelievedInPart) {
  Map map = straight_map({0, 1, 2, 4});
  const Matrix6d covariance = 4e-6 * Matrix6d::Identity();
  spread_correction(map, 0, 3, shifted(map, 3, {0.02, 0, 0}), covariance);
  EXPECT_NEAR(place(map, 3).x(), 4.01, 1e-9);
}

// 10 cm of standard deviation against 1.7 mm of the other 3 m: the rest of the path gets 3 parts in
// ten thousand of the correction.
TEST(SpreadCorrectionTest, AnOdometryGapTakesIt) {
  Map map = straight_map({0, 1, 2, 4});
  map.keyframe(2).link = OdometryLink{1, {}, 0.01 * Matrix6d::Identity()};
  spread_correction(map, 0, 3, shifted(map, 3, {0.2, 0, 0}), Matrix6d::Zero());
  EXPECT_NEAR(place(map, 1).x(), 1, 1e-4);
  EXPECT_NEAR(place(map, 2).x(), 2.2, 1e-4);
  EXPECT_NEAR(place(map, 3).x(), 4.2, 1e-4);
}

// Turned by 90 degrees about the origin and 1 m aside: (2, 0) comes to (0, 2) + (1, 0).
TEST(MoveFromTest, MovesAKeyframeAllLaterOnesAndTheirLandmarks) {
  Map map = straight_map({0, 1, 2, 4});
  const Eigen::Vector3d before = map.landmark(1).position;
  const Pose turn{
      Eigen::Quaterniond(Eigen::AngleAxisd(std::numbers::pi / 2, Eigen::Vector3d::UnitZ())),
      {1, 0, 0}};
  const Eigen::Vector3d of_third = turn * map.landmark(3).position;
  move_from(map, 2, turn);
  EXPECT_EQ(place(map, 1), Eigen::Vector3d(1, 0, 0));
  EXPECT_EQ(map.landmark(1).position, before);
  EXPECT_LT((place(map, 2) - Eigen::Vector3d(1, 2, 0)).norm(), 1e-12);
  EXPECT_LT((place(map, 3) - Eigen::Vector3d(1, 4, 0)).norm(), 1e-12);
  EXPECT_NEAR(yaw_of(map.keyframe(3).T_map_body.rotation), std::numbers::pi / 2, 1e-12);
  EXPECT_EQ(map.landmark(3).position, of_third);
}

TEST(MoveMapTest, AllMovesButTagsOfKnownPose) {
  Map map(1.2);
  auto frame = std::make_shared<FrameFeatures>();
  frame->views.resize(1);
  map.add_keyframe(frame, {Eigen::Quaterniond::Identity(), {2, 0, 0}}, {{}});
  map.landmarks().emplace_back();
  map.landmarks().back().position = {3, 0, 1};
  const Pose pivot{Eigen::Quaterniond::Identity(), {1, 0, 0}};
  map.tags().push_back({"tag36h11", 0, 0.161, pivot, true});
  map.tags().push_back({"tag36h11", 1, 0.161, pivot, false});
  map.gravity() = MapGravity{{0, 0, -9.8}};
  const Eigen::Quaterniond turn = exp_so3({0, -std::acos(0.0), 0});  // x to z, z to -x
  move_map(map, {turn, pivot.translation - turn * pivot.translation});
  EXPECT_LT((map.keyframe(0).T_map_body.translation - Eigen::Vector3d(1, 0, 1)).norm(), 1e-12);
  EXPECT_LT(map.keyframe(0).T_map_body.rotation.angularDistance(turn), 1e-7);  // acos near 1
  EXPECT_LT((map.landmark(0).position - Eigen::Vector3d(0, 0, 2)).norm(), 1e-12);
  EXPECT_EQ(map.tags()[0].T_map_tag.rotation.angularDistance(pivot.rotation), 0);
  EXPECT_LT(map.tags()[1].T_map_tag.rotation.angularDistance(turn), 1e-7);
  EXPECT_LT((map.tags()[1].T_map_tag.translation - pivot.translation).norm(), 1e-12);
  EXPECT_LT((map.gravity()->gravity - Eigen::Vector3d(9.8, 0, 0)).norm(), 1e-12);
}

// The world was found to lie 10 cm further along y: everything else moves back by as much.
TEST(KeepWorldTest, TheMapMovesUnderTheWorld) {
  Map map = straight_map({0, 1});
  map.tags().push_back({"tag36h11", 1, 0.161, {{1, 0, 0, 0}, {1, 2, 3}}});
  const Pose before{exp_so3({0, 0, 0.5}), {1, 2, 0}};
  map.world() = Pose{Eigen::Quaterniond::Identity(), {0, 0.1, 0}} * before;
  keep_world(map, before);
  EXPECT_EQ(map.world()->translation, before.translation);
  EXPECT_LT((place(map, 1) - Eigen::Vector3d(1, -0.1, 0)).norm(), 1e-12);
  EXPECT_LT((map.landmark(1).position - Eigen::Vector3d(1, 0.9, 0)).norm(), 1e-12);
  EXPECT_LT((map.tags()[0].T_map_tag.translation - Eigen::Vector3d(1, 1.9, 3)).norm(), 1e-12);
}

}  // namespace
}  // namespace vinebench::slam
